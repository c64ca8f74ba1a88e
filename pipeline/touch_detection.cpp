#include "pipeline/touch_detection.hpp"

namespace touchstone {

TouchDetection::TouchDetection(const Device& device, const TouchDetectionConfig& config,
                               const Intrinsics& intrinsics)
    : config_(config),
      intrinsics_(intrinsics),
      mapping_(device, config.map, intrinsics),
      map_(device, make_map_shape(intrinsics)),
      tracking_(config.tracking) {}

TrackedTouches TouchDetection::detect(const TouchInput& input) {
    std::vector<PixelRegion> regions;
    for (const PixelRegion& region : input.regions)
        regions.push_back(grown(region, config_.margin_px, intrinsics_.width_px, intrinsics_.height_px));
    mapping_.update(input.live.filtered_m, input.mask, input.background, regions, map_);
    candidates_.clear();
    if (regions.empty()) return tracking_.update({}, input.area, intrinsics_, input.timestamp_us);
    const auto live = input.live.depth_m.map_read();
    const auto height = map_.height_m.map_read();
    const auto background = input.background.depth_m.map_read();
    const auto normals = input.background.normals_c.map_read();
    const auto mask = input.mask.map_read();
    const TablePicture picture{intrinsics_,     map_.shape,          config_.map.noise, live.values(),
                               height.values(), background.values(), normals.values(),  mask.values()};
    candidates_ =
        detect_fingertips(picture, regions, tracking_.expected(input.timestamp_us), config_.fingertips);
    return tracking_.update(
        candidates_, input.area, intrinsics_, input.timestamp_us,
        [&](const FingerShape& shape) { return is_covered(picture, shape, config_.cover); });
}

}  // namespace touchstone
