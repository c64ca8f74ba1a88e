#include "platform/openni2_drivers/kinect/zero_plane.hpp"

#include <cmath>

namespace touchstone {
namespace {

constexpr double steps_per_disparity = 4.0;
constexpr double disparity_offset = 0.375;
constexpr double mm_per_cm = 10.0;
constexpr float nominal_color_focal_px = 525.0F;

}  // namespace

std::uint16_t raw_to_mm(std::uint16_t raw, const ZeroPlane& plane) {
    if (raw >= no_raw_depth) return 0;
    const double disparity =
        (raw - steps_per_disparity * plane.constant_shift) / steps_per_disparity - disparity_offset;
    const double shift = disparity * plane.pixel_size_mm;
    if (shift >= plane.emitter_baseline_cm) return 0;
    const double depth_cm =
        shift * plane.distance_mm / (plane.emitter_baseline_cm - shift) + plane.distance_mm;
    const double depth_mm = std::round(mm_per_cm * depth_cm);
    return depth_mm > 0 && depth_mm <= farthest_depth_mm ? static_cast<std::uint16_t>(depth_mm)
                                                         : std::uint16_t{0};
}

DepthTable depth_table(const ZeroPlane& plane) {
    DepthTable table{};
    for (std::size_t raw = 0; raw < table.size(); ++raw)
        table[raw] = raw_to_mm(static_cast<std::uint16_t>(raw), plane);
    return table;
}

Intrinsics depth_intrinsics(const ZeroPlane& plane) {
    const auto focal_px = static_cast<float>(plane.distance_mm / plane.pixel_size_mm / 2.0);
    return {focal_px, focal_px, 319.5F, 239.5F, 640, 480, {}};
}

Intrinsics color_intrinsics() {
    return {nominal_color_focal_px, nominal_color_focal_px, 319.5F, 239.5F, 640, 480, {}};
}

}  // namespace touchstone
