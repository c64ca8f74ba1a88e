#pragma once

#include <optional>

#include "platform/openni2_drivers/simulator/hand_layer.hpp"
#include "platform/openni2_drivers/simulator/scene.hpp"

namespace touchstone::sim {

/// A thing that a hand puts on the table and takes away again, once or again and again: config.object, put_s,
/// take_s, cycle_s. Size and place follow from the seed.
class PlacedObject {
  public:
    /// The hand comes in, sets down or takes hold, and is out of the view again within this time, s.
    static constexpr double visit_s = 1.2, hold_s = 0.15;

    PlacedObject(const SimulatorConfig& config, const Scene& scene, const TableView& view);

    struct Moment {
        std::optional<Shape> object;  ///< in the scene frame
        std::optional<Hand> hand;
    };
    Moment at(double time_s) const;

    /// As it stands on the table.
    const Shape& resting() const { return resting_; }
    const HandShape& hand_shape() const { return hand_shape_; }

  private:
    HandPosture posture(double share) const;

    double put_s_, take_s_, cycle_s_;
    Shape resting_;
    HandShape hand_shape_;
    HandPosture outside_, over_;
    Vec3 shoulder_s_ = Vec3::Zero();
};

/// Draws a shape in front of what is there.
void draw_shape(Picture& picture, const Shape& shape, const TableView& view);

/// Colours the pixels where draw_shape has drawn last and no hand is in front.
void color_shape(std::vector<std::uint8_t>& color_rgb, const Picture& picture, const Shape& shape,
                 const TableView& view);

}  // namespace touchstone::sim
