#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace touchstone {

/// What a projector throws in its own pixels instead of the scene, while it is calibrated or checked.
struct ThrownPicture {
    std::vector<std::uint8_t> gray;           ///< one byte a pixel, row 0 at the top; empty: black, and
    std::optional<Eigen::Vector2f> cross_px;  ///< a cross to be touched
    std::string words;                        ///< what to do
};

}  // namespace touchstone
