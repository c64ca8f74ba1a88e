#include "pipeline/color_integration.hpp"

#include <cmath>
#include <numbers>

#include "pipeline/kernel_program.hpp"

namespace touchstone {

namespace {

ColorParams make_params(const ColorIntegrationConfig& config) {
    const float max_angle_rad = config.max_angle_deg * std::numbers::pi_v<float> / 180.0f;
    return {config.noise, config.band_vox, std::cos(max_angle_rad), config.edge_gap_per_m, config.guard_px};
}

LaunchSize one_brick_each(std::size_t bricks) { return {{64 * bricks, 1, 1}, {64, 1, 1}}; }

}  // namespace

ColorIntegration::ColorIntegration(const Device& device, const ColorIntegrationConfig& config,
                                   const Intrinsics& intrinsics)
    : device_(&device),
      intrinsics_(intrinsics),
      shape_(make_map_shape(intrinsics)),
      params_(make_params(config)),
      program_(load_kernel_program(device, "color_integration.cl")),
      color_weights_(program_.kernel("color_weights")),
      find_surface_bricks_(program_.kernel("find_surface_bricks")),
      integrate_colors_(program_.kernel("integrate_colors")),
      weights_(device, map_pixels(shape_)),
      rgb_(device, 3 * static_cast<std::size_t>(intrinsics.width_px) *
                       static_cast<std::size_t>(intrinsics.height_px)) {}

void ColorIntegration::integrate(TsdfVolume& volume, const LiveMaps& live, std::span<const std::uint8_t> rgb,
                                 const Buffer<std::uint8_t>& sample_weights, const RigidTransform& T_g_c,
                                 std::span<const int> bricks) {
    if (rgb.size() != rgb_.size())
        throw Error(ExitStatus::bad_data, "a colour picture has another size than the depth picture");
    if (bricks.empty()) return;
    const std::size_t count = place_bricks(volume, bricks);
    if (count == 0) return;
    rgb_.write(rgb);
    color_weights_.launch(eight_pixels_each(shape_), live.depth_m, live.normals_c, sample_weights, weights_,
                          shape_, intrinsics_, params_);
    integrate_colors_.launch(one_brick_each(count), places_, volume.pool(), volume.colors()->colors(),
                             live.depth_m, weights_, rgb_, volume.params(), params_, intrinsics_, shape_,
                             to_pose(T_g_c.inverse()));
}

std::size_t ColorIntegration::place_bricks(TsdfVolume& volume, std::span<const int> bricks) {
    if (slots_.size() < bricks.size()) {
        slots_ = Buffer<int>(*device_, 2 * bricks.size());
        places_ = Buffer<int>(*device_, 6 * bricks.size());
        flags_ = Buffer<std::uint8_t>(*device_, 2 * bricks.size());
    }
    {
        const auto slots = slots_.map_write();
        for (std::size_t i = 0; i < bricks.size(); ++i) slots[i] = volume.slot(bricks[i]);
    }
    flags_.fill(0);
    find_surface_bricks_.launch(one_brick_each(bricks.size()), slots_, volume.pool(), flags_, volume.params(),
                                params_);
    std::vector<int> at_surface;
    {
        const auto flags = flags_.map_read(bricks.size());
        for (std::size_t i = 0; i < bricks.size(); ++i) {
            if (flags[i] != 0) at_surface.push_back(bricks[i]);
        }
    }
    ColorPool& colors = volume.keep_colors();
    colors.allocate(at_surface);
    const auto places = places_.map_write();
    for (std::size_t i = 0; i < at_surface.size(); ++i) {
        places[3 * i] = at_surface[i];
        places[3 * i + 1] = volume.slot(at_surface[i]);
        places[3 * i + 2] = colors.slot(at_surface[i]);
    }
    return at_surface.size();
}

}  // namespace touchstone
