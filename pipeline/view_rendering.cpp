#include "pipeline/view_rendering.hpp"

#include <algorithm>
#include <cmath>

#include "pipeline/kernel_program.hpp"
#include "pipeline/rendering.hpp"

namespace touchstone {

namespace {

Float4 with(const Eigen::Vector3f& v, float w) { return {v.x(), v.y(), v.z(), w}; }

ViewLightingParams make_params(const ViewLook& look, const ViewScene& scene) {
    constexpr float rad_per_deg = 0.017453293f;
    ViewLightingParams params{};
    params.light_g_m = with(scene.light_g_m, 0.0f);
    if (scene.sphere) params.sphere_g_m = with(scene.sphere->centre_g_m, scene.sphere->radius_m);
    params.surface = with(look.surface, look.specular);
    params.unknown = with(look.unknown, 0.0f);
    params.sky_low = with(look.sky_low, 0.0f);
    params.sky_high = with(look.sky_high, 0.0f);
    params.up_g = with(look.up_g, 0.0f);
    params.ambient = look.ambient;
    params.diffuse = look.diffuse;
    params.grazing_cos = std::max(1e-3f, std::cos(look.grazing_angle_deg * rad_per_deg));
    params.start_vox = look.shadow_start_vox;
    params.mirror = look.mirror;
    return params;
}

/// Pixel (x, y) of the half view is pixel (2x, 2y) of the whole.
Intrinsics halved(const Intrinsics& k) {
    return {0.5f * k.fx_px,       0.5f * k.fy_px,        0.5f * k.cx_px, 0.5f * k.cy_px,
            (k.width_px + 1) / 2, (k.height_px + 1) / 2, {0, 0}};
}

}  // namespace

ViewRendering::HalfView::HalfView(const Device& device, const Intrinsics& half)
    : intrinsics(half),
      raycasting(device, half),
      surface(device, make_map_shape(half)),
      picture(device, make_map_shape(half)) {}

ViewRendering::ViewRendering(const Device& device, const ViewLook& look, const Intrinsics& intrinsics)
    : device_(&device),
      look_(look),
      intrinsics_(intrinsics),
      lighting_(load_kernel_program(device, "view_lighting.cl", "view_rays.h")),
      spreading_(load_kernel_program(device, "view_spreading.cl")),
      light_view_(lighting_.kernel("light_view")),
      spread_view_(spreading_.kernel("spread_view")),
      skipping_(device),
      raycasting_(device, intrinsics),
      surface_(device, make_map_shape(intrinsics)),
      picture_(device, make_map_shape(intrinsics)),
      color_table_(device, 1),
      no_colors_(device, 1) {}

ShadedView ViewRendering::render(const TsdfVolume& volume, const RigidTransform& T_g_c,
                                 const ViewScene& scene, ViewQuality quality) {
    if (quality == ViewQuality::full) {
        raycasting_.raycast(volume, T_g_c, surface_);
        return light(volume, T_g_c, surface_, scene);
    }
    if (!half_) half_.emplace(*device_, halved(intrinsics_));
    half_->raycasting.raycast(volume, T_g_c, half_->surface);
    launch(volume, T_g_c, half_->surface, scene, half_->intrinsics, 2, half_->picture);
    spread_view_.launch(sixteen_pixels_each(picture_.shape), half_->picture.rgba, half_->picture.depth_m,
                        picture_.rgba, picture_.depth_m, half_->picture.shape, picture_.shape);
    return read_view(picture_.rgba, picture_.shape);
}

ShadedView ViewRendering::light(const TsdfVolume& volume, const RigidTransform& T_g_c,
                                const SurfacePrediction& surface, const ViewScene& scene) {
    launch(volume, T_g_c, surface, scene, intrinsics_, 1, picture_);
    return read_view(picture_.rgba, picture_.shape);
}

void ViewRendering::launch(const TsdfVolume& volume, const RigidTransform& T_g_c,
                           const SurfacePrediction& surface, const ViewScene& scene,
                           const Intrinsics& intrinsics, int mesh_step, Picture& picture) {
    ViewLightingParams params = make_params(look_, scene);
    skipping_.update(volume);
    params.low_vox = with(skipping_.low_vox(), 0.0f);
    params.high_vox = with(skipping_.high_vox(), 0.0f);
    params.has_colors = update_color_table(volume) ? 1 : 0;
    params.mesh_step = scene.mesh != nullptr ? mesh_step : 0;
    // Where there is no mesh the kernel reads none: any map will do.
    const MeshMaps mesh =
        scene.mesh != nullptr ? *scene.mesh : MeshMaps{surface.depth_m, surface.normals_c, picture.rgba};
    // The same of its shadow.
    const MeshShadow shadow = scene.mesh_shadow != nullptr
                                  ? *scene.mesh_shadow
                                  : MeshShadow{surface.depth_m, {}, RigidTransform::Identity()};
    const Buffer<std::uint32_t>& colors = params.has_colors != 0 ? volume.colors()->colors() : no_colors_;
    light_view_.launch(eight_pixels_each(picture.shape), skipping_.table(), volume.pool(), color_table_,
                       colors, surface.depth_m, surface.normals_c, mesh.depth_m, mesh.normals_c, mesh.rgba,
                       picture.rgba, picture.depth_m, volume.params(), intrinsics, picture.shape,
                       picture_.shape, to_pose(T_g_c), params, static_cast<int>(scene.style), shadow.depth_m,
                       shadow.intrinsics, make_map_shape(shadow.intrinsics), to_pose(shadow.T_l_g));
}

bool ViewRendering::update_color_table(const TsdfVolume& volume) {
    if (volume.colors() == nullptr || volume.colors()->bricks().empty()) return false;
    if (color_table_.size() != volume.brick_count())
        color_table_ = Buffer<int>(*device_, volume.brick_count());
    const auto table = color_table_.map_write();
    std::ranges::fill(table.values(), -1);
    for (const int brick : volume.colors()->bricks())
        table[static_cast<std::size_t>(brick)] = volume.colors()->slot(brick);
    return true;
}

}  // namespace touchstone
