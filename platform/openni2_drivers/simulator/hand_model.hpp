#pragma once

#include <vector>

#include "platform/openni2_drivers/simulator/geometry.hpp"
#include "platform/openni2_drivers/simulator/random.hpp"

namespace touchstone::sim {

/// What stays the same about a hand; drawn from the seed.
struct HandShape {
    float fingertip_radius_m = 0.0075F;
    float scale = 1.0F;      ///< 1 = a hand of 185 mm
    float side = 1.0F;       ///< +1 right, -1 left hand
    float sleeve_mm = 8.0F;  ///< of a sleeve from the skin, in millimetres of the model hand
    Vec3 skin{0.85F, 0.62F, 0.5F};
    Vec3 sleeve{0.2F, 0.25F, 0.4F};
};

/// Where the two fingers that touch are, and how the rest of the hand hangs on them. Scene frame.
struct HandPosture {
    Vec3 index_tip = Vec3::Zero();  ///< middle of the rounded end
    Vec3 thumb_tip = Vec3::Zero();
    float yaw_rad = 0.0F;    ///< pointing direction on the table, from +x to +y
    float pitch_rad = 0.8F;  ///< of the index's last joint, down from level
    float bend_rad = 0.3F;   ///< by how much less the index is pitched at the knuckle
    float curl = 0.5F;       ///< of the three other fingers: 0 stretched, 1 a fist
};

enum class HandMaterial : std::uint8_t { skin, sleeve };

struct HandPart {
    RoundCone cone;
    HandMaterial material = HandMaterial::skin;
    /// Free space that a planned movement leaves around it.
    float clearance_m = 0.002F;
    /// The end `a` is a fingertip that is meant to touch: only the rest of the part keeps its distance.
    bool touches = false;
};

/// A posed hand with its arm: parts[0] is the last joint of the index, parts[1] of the thumb, both with their
/// tip at `a`.
struct Hand {
    std::vector<HandPart> parts;
    const RoundCone& index() const { return parts[0].cone; }
    const RoundCone& thumb() const { return parts[1].cone; }
};

HandShape make_hand_shape(Random& random, float side);

/// The arm runs to the shoulder. A thumb tip out of reach ends where the thumb does.
Hand build_hand(const HandShape& shape, const HandPosture& posture, const Vec3& shoulder_s,
                bool thumb_touches);

/// Where the thumb rests when it is not in use.
Vec3 relaxed_thumb_tip(const HandShape& shape, const HandPosture& posture);

/// Pointing direction of something pitched down from level.
Vec3 pointing(float yaw_rad, float pitch_rad);

}  // namespace touchstone::sim
