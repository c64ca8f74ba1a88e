#include "pipeline/depth_map_conversion.hpp"

#include <algorithm>

#include "pipeline/kernel_program.hpp"

namespace touchstone {

DepthMapConversion::DepthMapConversion(const Device& device, const DepthMapConversionConfig& config,
                                       const Intrinsics& intrinsics)
    : config_(config),
      intrinsics_(intrinsics),
      shape_(make_map_shape(intrinsics)),
      params_{config.noise, config.filter_sigma_px, config.filter_range_sigmas, config.min_depth_m,
              config.max_depth_m},
      program_(load_kernel_program(device, "depth_map_conversion.cl")),
      convert_depth_(program_.kernel("convert_depth")),
      bilateral_filter_(program_.kernel("bilateral_filter")),
      normal_map_(program_.kernel("normal_map")),
      depth_mm_(device, static_cast<std::size_t>(intrinsics.width_px) *
                            static_cast<std::size_t>(intrinsics.height_px)),
      column_shift_(device, static_cast<std::size_t>(shape_.pitch_px)) {
    column_shift_.fill(0.0f);
}

void DepthMapConversion::convert(const DepthView& view, LiveMaps& live) {
    convert_depth(view, live);
    find_normals(live);
}

void DepthMapConversion::convert_depth(const DepthView& view, LiveMaps& live) {
    std::ranges::copy(view.depth_mm, depth_mm_.map_write().values().begin());
    convert_depth_.launch(eight_pixels_each(shape_), depth_mm_, live.depth_m, shape_, params_, column_shift_);
    bilateral_filter_.launch(sixteen_pixels_each(shape_), live.depth_m, live.filtered_m, shape_, params_);
}

void DepthMapConversion::find_normals(LiveMaps& live) {
    normal_map_.launch(eight_pixels_each(shape_), live.filtered_m, live.normals_c, shape_, intrinsics_,
                       config_.normal_gap_per_m);
}

void DepthMapConversion::set_column_shift(std::span<const float> shift_per_m) {
    const auto mapped = column_shift_.map_update();
    std::ranges::copy(shift_per_m, mapped.values().begin());
}

}  // namespace touchstone
