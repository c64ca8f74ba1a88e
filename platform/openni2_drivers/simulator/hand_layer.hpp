#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "platform/openni2_drivers/simulator/hand_model.hpp"
#include "platform/openni2_drivers/simulator/table_view.hpp"

namespace touchstone::sim {

/// One frame's picture before colour and noise.
struct Picture {
    std::vector<float> depth_m;       ///< z, row-major
    std::vector<std::uint8_t> part;   ///< 0 = the scene, else 1 + number of the hand's part
    std::vector<std::uint8_t> owner;  ///< the hand that `part` belongs to; meaningless where part is 0
};

/// Lets the picture show the scene alone.
void clear_picture(Picture& picture, const std::vector<float>& static_depth_m);

/// Draws a hand in front of what is there. Costs only the pixels around its parts.
void draw_hand(Picture& picture, const Hand& hand, int owner, const TableView& view);

/// Colours the pixels of a hand that draw_hand has drawn.
void color_hand(std::vector<std::uint8_t>& color_rgb, const Picture& picture, const Hand& hand,
                const HandShape& shape, int owner, const TableView& view);

}  // namespace touchstone::sim
