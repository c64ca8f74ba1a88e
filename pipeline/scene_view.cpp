#include "pipeline/scene_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace touchstone {

namespace {

constexpr int frames_until_old = 150;
constexpr float dimmed = 0.45f;         // the scan behind the foreground that is to be seen
constexpr float same_shift_m = 1e-4f;   // of the camera
constexpr float same_turn_rad = 1e-4f;  // of the camera
constexpr int largest_splat_px = 5;
constexpr std::array<float, 3> foreground_color{0.93f, 0.62f, 0.42f};  // that of the table's view

bool is_same(const RigidTransform& a, const RigidTransform& b) {
    const RigidTransform T = a.inverse() * b;
    return T.translation().norm() < same_shift_m && Eigen::AngleAxisf(T.linear()).angle() < same_turn_rad;
}

/// Rows of a picture without padding into a plane of a map.
template <class T>
void write_plane(Buffer<T>& map, const MapShape& shape, std::size_t plane, std::span<const T> picture) {
    const auto values = map.map_write();
    const auto width = static_cast<std::size_t>(shape.width_px);
    for (int y = 0; y < shape.height_px; ++y)
        std::ranges::copy(picture.subspan(static_cast<std::size_t>(y) * width, width),
                          &values[plane * map_pixels(shape) + map_index(shape, 0, y)]);
}

void dim(ShadedView& picture) {
    for (std::size_t byte = 0; byte < picture.rgba.size(); ++byte) {
        if (byte % 4 == 3) continue;
        picture.rgba[byte] = static_cast<std::uint8_t>(dimmed * static_cast<float>(picture.rgba[byte]));
    }
}

/// A square of pixels about a place, as large as a pixel of the camera is from there.
struct Splat {
    int x0, y0, x1, y1;
};

Splat splat_about(const Eigen::Vector2f& place_px, float size_px, const Intrinsics& k) {
    const float size = std::clamp(std::ceil(size_px), 1.0f, static_cast<float>(largest_splat_px));
    const auto first = [&](float at) { return static_cast<int>(std::floor(at - 0.5f * size + 0.5f)); };
    const int x = first(place_px.x()), y = first(place_px.y()), side = static_cast<int>(size);
    return {std::max(x, 0), std::max(y, 0), std::min(x + side, k.width_px), std::min(y + side, k.height_px)};
}

void draw_splat(const Splat& splat, float z_m, const std::array<std::uint8_t, 3>& rgb,
                std::vector<float>& picture_m, ShadedView& picture) {
    for (int y = splat.y0; y < splat.y1; ++y) {
        for (int x = splat.x0; x < splat.x1; ++x) {
            const auto at = static_cast<std::size_t>(y * picture.width_px + x);
            if (picture_m[at] > 0.0f && picture_m[at] <= z_m) continue;
            picture_m[at] = z_m;
            std::ranges::copy(rgb, &picture.rgba[4 * at]);
        }
    }
}

std::array<std::uint8_t, 3> lit_foreground(float facing) {
    const float level = 0.35f + 0.65f * std::clamp(facing, 0.0f, 1.0f);
    std::array<std::uint8_t, 3> rgb{};
    for (std::size_t i = 0; i < 3; ++i)
        rgb[i] = static_cast<std::uint8_t>(255.0f * level * foreground_color[i]);
    return rgb;
}

}  // namespace

void cut_out_hands(const SceneViewFrame& frame, std::span<const float> picture_m, ShadedView& picture) {
    const auto live_m = frame.live.depth_m.map_read();
    std::size_t pixel = 0;
    for (int y = 0; y < picture.height_px; ++y) {
        const float* live = &live_m[map_index(frame.live.shape, 0, y)];
        for (int x = 0; x < picture.width_px; ++x, ++pixel) {
            if (frame.foreground[pixel] == 0) continue;
            const bool virtual_is_nearer =
                picture_m[pixel] > 0.0f && live[x] > 0.0f && picture_m[pixel] < live[x];
            if (!virtual_is_nearer) std::fill_n(&picture.rgba[4 * pixel], 4, std::uint8_t{0});
        }
    }
}

void draw_foreground(const SceneViewFrame& frame, const Intrinsics& intrinsics, const RigidTransform& T_g_v,
                     std::vector<float>& picture_m, ShadedView& picture) {
    const RigidTransform T_v_c = T_g_v.inverse() * frame.T_g_c;
    const auto live_m = frame.live.depth_m.map_read();
    const auto normals_c = frame.live.normals_c.map_read();
    const std::size_t plane = map_pixels(frame.live.shape);
    std::size_t pixel = 0;
    for (int y = 0; y < intrinsics.height_px; ++y) {
        for (int x = 0; x < intrinsics.width_px; ++x, ++pixel) {
            const std::size_t at = map_index(frame.live.shape, x, y);
            if (frame.foreground[pixel] == 0 || live_m[at] <= 0.0f) continue;
            const Eigen::Vector3f p_v = T_v_c * back_project(intrinsics, x, y, live_m[at]);
            if (p_v.z() < 0.05f) continue;
            const Eigen::Vector3f normal_v =
                T_v_c.linear() *
                Eigen::Vector3f(normals_c[at], normals_c[plane + at], normals_c[2 * plane + at]);
            const auto rgb = lit_foreground(normal_v.isZero() ? 1.0f : -normal_v.dot(p_v.normalized()));
            const Eigen::Vector2f place_px = project(intrinsics, p_v);
            const Splat splat = splat_about(place_px, 1.2f * live_m[at] / p_v.z(), intrinsics);
            draw_splat(splat, p_v.z(), rgb, picture_m, picture);
        }
    }
}

SceneView::SceneView(const Device& device, const Intrinsics& intrinsics)
    : device_(&device), intrinsics_(intrinsics), shape_(make_map_shape(intrinsics)) {}

std::shared_ptr<const RenderedView> SceneView::see(const ViewWish& wish, const SceneViewFrame& frame) {
    if (is_good(wish, frame))
        ++frames_shown_;
    else
        render(wish, frame);
    auto result = std::make_shared<RenderedView>(*shown_);
    if (!wish.T_g_v) cut_out_hands(frame, shown_m_, result->picture);
    if (wish.style == ViewStyle::foreground) {
        std::vector<float> depth_m = shown_m_;
        draw_foreground(frame, intrinsics_, T_g_v_, depth_m, result->picture);
    }
    return result;
}

bool SceneView::is_good(const ViewWish& wish, const SceneViewFrame& frame) const {
    return shown_ && shown_->version == wish.version && (shown_->is_full_quality || wish.moving) &&
           (wish.T_g_v || is_same(T_g_v_, frame.T_g_c)) && frames_shown_ < frames_until_old;
}

void SceneView::render(const ViewWish& wish, const SceneViewFrame& frame) {
    ViewRendering& rendering = rendering_for(frame);
    const ViewScene scene{lamp_g_m(frame.area, frame.T_g_c), wish.sphere, upload(wish.mesh.get()),
                          upload_shadow(wish), wish.style};
    T_g_v_ = wish.T_g_v.value_or(frame.T_g_c);
    const bool full = !wish.moving;
    shown_.emplace();
    shown_->version = wish.version;
    shown_->is_full_quality = full;
    shown_->has_colors = frame.volume.colors() != nullptr;
    if (full && !wish.T_g_v)
        shown_->picture = rendering.light(frame.volume, T_g_v_, frame.background, scene);
    else
        shown_->picture =
            rendering.render(frame.volume, T_g_v_, scene, full ? ViewQuality::full : ViewQuality::half);
    if (wish.style == ViewStyle::foreground) dim(shown_->picture);
    shown_m_ = without_padding(rendering.depth_m(), shape_);
    frames_shown_ = 0;
    ++renderings_;
}

ViewRendering& SceneView::rendering_for(const SceneViewFrame& frame) {
    const Eigen::Vector3f up_g = frame.T_g_c.linear() * facing_normal(frame.area);
    if (!rendering_ || up_g.dot(up_g_) < 0.999f) {
        ViewLook look;
        look.up_g = up_g_ = up_g;
        rendering_.emplace(*device_, look, intrinsics_);
    }
    return *rendering_;
}

const MeshMaps* SceneView::upload(const MeshPicture* mesh) {
    const auto pixels = static_cast<std::size_t>(intrinsics_.width_px * intrinsics_.height_px);
    if (mesh == nullptr || mesh->depth_m.size() != pixels) return nullptr;
    if (!mesh_) {
        mesh_.emplace(*device_, shape_);
        mesh_->depth_m.fill(0.0f);
    }
    write_plane<float>(mesh_->depth_m, shape_, 0, mesh->depth_m);
    for (std::size_t plane = 0; plane < 3; ++plane)
        write_plane<float>(mesh_->normals_c, shape_, plane,
                           std::span(mesh->normals_c).subspan(plane * pixels, pixels));
    write_plane<std::uint32_t>(mesh_->rgba, shape_, 0, mesh->rgba);
    mesh_maps_.emplace(MeshMaps{mesh_->depth_m, mesh_->normals_c, mesh_->rgba});
    return &*mesh_maps_;
}

const MeshShadow* SceneView::upload_shadow(const ViewWish& wish) {
    if (!wish.mesh_from_light) return nullptr;
    const MeshPicture& picture = *wish.mesh_from_light;
    const MapShape shape = make_map_shape(picture.intrinsics);
    const auto pixels = static_cast<std::size_t>(shape.width_px * shape.height_px);
    if (pixels == 0 || picture.depth_m.size() != pixels) return nullptr;
    if (!shadow_m_ || shadow_m_->size() != map_pixels(shape)) {
        mesh_shadow_.reset();
        shadow_m_.emplace(*device_, map_pixels(shape));
        shadow_m_->fill(0.0f);
    }
    write_plane<float>(*shadow_m_, shape, 0, picture.depth_m);
    mesh_shadow_.emplace(MeshShadow{*shadow_m_, picture.intrinsics, wish.T_g_l.inverse()});
    return &*mesh_shadow_;
}

}  // namespace touchstone
