#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "platform/openni2_drivers/kinect/zero_plane.hpp"

namespace touchstone {

/// Takes depth from the infrared camera's view to the colour camera's.
struct RegistrationTables {
    struct Place {
        std::int32_t x;  ///< in 256ths of a pixel
        std::int32_t y;
    };
    std::vector<Place> places;           ///< of each depth pixel, row-major, before the shift
    std::vector<std::int32_t> shifts_x;  ///< by depth in mm, 256ths of a pixel to the right
    int first_row = 0;                   ///< of the colour picture that is kept
};

/// Two cameras that look the same way, the colour camera `color_baseline_cm` to the right of the infrared one
/// in the picture: for devices that do not tell their own tables.
RegistrationTables nominal_registration(const ZeroPlane& plane);

/// Depth as the colour camera would see it; the nearer of two points that meet stays, the rest is 0.
void register_depth(std::span<const std::uint16_t> depth_mm, const RegistrationTables& tables,
                    std::span<std::uint16_t> registered_mm);

}  // namespace touchstone
