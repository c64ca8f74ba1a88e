#include "pipeline/rendering.hpp"

#include <cstring>

#include "pipeline/kernel_program.hpp"

namespace touchstone {

namespace {

const char* kernel_of_view(const std::string& view) {
    if (view == "shaded" || view == "camera") return "shade_view";
    if (view == "normals") return "show_normals";
    throw Error(ExitStatus::configuration, "rendering.view is shaded, normals or camera");
}

}  // namespace

Rendering::Rendering(const Device& device, const RenderingConfig& config, const Intrinsics& intrinsics)
    : config_(config),
      intrinsics_(intrinsics),
      shape_(make_map_shape(intrinsics)),
      program_(load_kernel_program(device, "shading.cl")),
      show_(program_.kernel(kernel_of_view(config.view))),
      rgba_(device, map_pixels(shape_)) {}

ShadedView Rendering::render(const SurfacePrediction& background, const ForegroundLayer& foreground) {
    show_.launch(eight_pixels_each(shape_), background.depth_m, background.normals_c, foreground.normals_c,
                 foreground.mask, rgba_, shape_, intrinsics_, config_.shading);
    return read_view(rgba_, shape_);
}

ShadedView camera_view(std::span<const std::uint8_t> rgb, std::span<const std::uint8_t> foreground,
                       const Intrinsics& intrinsics) {
    ShadedView view{intrinsics.width_px, intrinsics.height_px, {}};
    view.rgba.resize(4 * foreground.size());
    for (std::size_t pixel = 0; pixel < foreground.size(); ++pixel) {
        std::memcpy(&view.rgba[4 * pixel], &rgb[3 * pixel], 3);
        view.rgba[4 * pixel + 3] = foreground[pixel] != 0 ? 0 : 255;
    }
    return view;
}

ShadedView read_view(const Buffer<std::uint32_t>& rgba, const MapShape& shape) {
    ShadedView view{shape.width_px, shape.height_px, {}};
    const std::size_t row_bytes = 4 * static_cast<std::size_t>(shape.width_px);
    view.rgba.resize(row_bytes * static_cast<std::size_t>(shape.height_px));
    const auto padded = rgba.map_read();
    for (int y = 0; y < shape.height_px; ++y) {
        std::memcpy(view.rgba.data() + static_cast<std::size_t>(y) * row_bytes,
                    &padded[map_index(shape, 0, y)], row_bytes);
    }
    return view;
}

}  // namespace touchstone
