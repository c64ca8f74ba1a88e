#pragma once

#include <vector>

#include "platform/openni2_drivers/simulator/hand_model.hpp"
#include "platform/openni2_drivers/simulator/scene.hpp"
#include "platform/openni2_drivers/simulator/table_view.hpp"

namespace touchstone::sim {

/// Where a hand works: the scene, what the camera sees of it, and the part of it that belongs to this hand.
struct Workplace {
    const Scene& scene;
    const TableView& view;
    const std::vector<float>& depth_m;  ///< of the scene alone, for each pixel
    /// -1: the hand stays at x < 0; +1: at x > 0; 0: anywhere. The camera hangs over x = 0, so that two hands
    /// that keep to their halves neither touch nor hide one another.
    float half = 0.0F;
};

/// Whether the posed hand keeps every part's distance from the scene, and keeps to its half.
bool is_clear(const Hand& hand, const Workplace& place);

/// Whether the camera sees the middle of the fingertip of parts[part], past all other parts of the hand and
/// the scene.
bool is_tip_visible(const Hand& hand, std::size_t part, const Workplace& place);

/// Distance of a ball's skin from the scene, metres.
inline float gap_m(const Scene& scene, const Vec3& center_s, float radius_m) {
    return scene.distance(center_s) - radius_m;
}

}  // namespace touchstone::sim
