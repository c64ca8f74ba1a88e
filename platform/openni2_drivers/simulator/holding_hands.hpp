#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "platform/openni2_drivers/simulator/hand_model.hpp"
#include "platform/openni2_drivers/simulator/mesh_distance.hpp"
#include "platform/openni2_drivers/simulator/turned_object.hpp"

namespace touchstone::sim {

/// Two hands that turn an object: one from the left, one from the right, each with four fingers behind and
/// the thumb in front. They move with the object through two strokes, then, in turns, let go and take hold
/// elsewhere.
class HoldingHands {
  public:
    /// Lengths of the mesh in metres, in the object's frame.
    HoldingHands(const TriangleMesh& mesh, const TurnedObject& turned, std::uint64_t seed);

    /// The hand (0 left, 1 right) in the frame w of TurnedObject at one of its frames.
    Hand at(int hand, int frame) const;
    const HandShape& shape(int hand) const { return shapes_[static_cast<std::size_t>(hand)]; }
    /// Whether the hand lets go at this frame.
    static bool changes(int hand, int frame);

  private:
    /// The joints of a hand that holds: thumb first, then the fingers; in the object's frame.
    struct Grip {
        int until_frame = 0;  ///< when the hand begins to let go
        std::array<Vec3, 5> tips, joints, knuckles;
        Vec3 wrist = Vec3::Zero();
        Vec3 outward = Vec3::Zero();  ///< from the object to the hand
    };

    Grip take_hold(const MeshDistance& surface, int hand, int from_frame, int until_frame,
                   Random& random) const;
    static Grip moved(const Grip& grip, const Eigen::Isometry3f& T);
    static Grip between(const Grip& from, const Grip& to, float share);
    Hand build(const Grip& grip_w, int hand) const;

    TurnedObject turned_;
    std::array<HandShape, 2> shapes_;
    std::array<std::vector<Grip>, 2> grips_;  ///< of each hand, in the order of time
};

}  // namespace touchstone::sim
