#include "platform/openni2_drivers/kinect/registration.hpp"

#include <algorithm>
#include <cmath>

namespace touchstone {
namespace {

constexpr int width_px = 640, height_px = 480;
constexpr double subpixels = 256.0;
constexpr double mm_per_cm = 10.0;

}  // namespace

RegistrationTables nominal_registration(const ZeroPlane& plane) {
    const Intrinsics depth = depth_intrinsics(plane), color = color_intrinsics();
    const double zoom = double{color.fx_px} / double{depth.fx_px};
    RegistrationTables tables;
    for (int y = 0; y < height_px; ++y) {
        const double color_y = (y - double{depth.cy_px}) * zoom + double{color.cy_px};
        for (int x = 0; x < width_px; ++x) {
            const double color_x = (x - double{depth.cx_px}) * zoom + double{color.cx_px};
            tables.places.push_back({static_cast<std::int32_t>(std::lround((color_x + 0.5) * subpixels)),
                                     static_cast<std::int32_t>(std::lround(color_y))});
        }
    }
    tables.shifts_x.push_back(0);
    for (int mm = 1; mm <= farthest_depth_mm; ++mm) {
        const double shift_px = -double{color.fx_px} * plane.color_baseline_cm * mm_per_cm / mm;
        tables.shifts_x.push_back(static_cast<std::int32_t>(std::lround(shift_px * subpixels)));
    }
    return tables;
}

void register_depth(std::span<const std::uint16_t> depth_mm, const RegistrationTables& tables,
                    std::span<std::uint16_t> registered_mm) {
    std::fill(registered_mm.begin(), registered_mm.end(), std::uint16_t{0});
    for (std::size_t i = 0; i < depth_mm.size(); ++i) {
        const std::uint16_t mm = depth_mm[i];
        if (mm == 0 || mm >= tables.shifts_x.size()) continue;
        const std::int32_t x = (tables.places[i].x + tables.shifts_x[mm]) >> 8;
        const std::int32_t y = tables.places[i].y - tables.first_row;
        if (x < 0 || x >= width_px || y < 0 || y >= height_px) continue;
        std::uint16_t& target = registered_mm[static_cast<std::size_t>(y * width_px + x)];
        if (target == 0 || mm < target) target = mm;
    }
}

}  // namespace touchstone
