#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

namespace touchstone {

enum class TouchPhase { down, move, up };

/// What a finger does, as far as the camera tells.
enum class FingerState {
    away,      ///< not seen, and not in contact when it was
    hover,     ///< above the surface
    down,      ///< in contact where it came down
    dragging,  ///< in contact, and has moved since
    hidden,    ///< was in contact and is not seen: unknown, not up
};

/// A finger over or on the surface, as the UI and the sinks see it.
struct Fingertip {
    int id = 0;                                  ///< the same as long as the finger is followed
    Eigen::Vector3f surface_c_m{0.f, 0.f, 0.f};  ///< camera frame: the point on the surface under the pad
    Eigen::Vector2f pixel_px{0.f, 0.f};          ///< that point in the depth picture
    Eigen::Vector2f area_uv{0.f, 0.f};           ///< that point in the interactive area, 0..1 inside it
    float height_m = 0.f;                        ///< of the finger's pad above the surface, signed distance
    Eigen::Vector3f normal_c{0.f, 0.f, 0.f};     ///< camera frame: of the surface there
    Eigen::Vector3f axis_c{0.f, 0.f, 0.f};       ///< camera frame, unit length, from the tip to the hand
    FingerState state = FingerState::away;
    int area = -1;                       ///< of the table's named ones; -1: none of them
    Eigen::Vector2f named_uv{0.f, 0.f};  ///< in that area
};

/// A finger in contact; a hidden one goes on as `move` at its last place. `up` is sent once, in the first
/// frame without contact, with the last known place.
struct TouchEvent {
    Fingertip tip;
    TouchPhase phase = TouchPhase::down;
};

/// A finger near the surface without contact.
struct HoverEvent {
    Fingertip tip;
};

/// The cross to touch next, while touches are calibrated.
struct CrossGuide {
    Eigen::Vector2f pixel_px{0.f, 0.f};  ///< in the depth picture
    int touched = 0, wanted = 0;         ///< touches
    std::string words;                   ///< what to do
};

}  // namespace touchstone
