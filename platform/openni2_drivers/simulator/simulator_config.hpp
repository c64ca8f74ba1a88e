#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace touchstone {

/// Tables under a fixed camera; a furnished corner and an empty wall before a camera that may move; an object
/// that is turned before a fixed camera.
enum class SimulatedScene { flat, curved, cluttered, bowl, mixed, room, wall, object };

/// How the camera moves before `room` and `wall`.
enum class CameraMotion {
    still,
    sweep,  ///< by hand through the scene: about 8 mm and 0.5 degrees a frame, with tremor
    orbit,  ///< to and fro around the middle of the scene
    rpy,    ///< fast turns, up to 5 degrees a frame, about one axis after the other
    slide,  ///< sideways, to and fro
};

/// What a hand puts on a table, or takes from it.
enum class ObjectKind { none, box, ball, can, book };

/// What the arms over a table wear.
enum class Sleeve {
    loose,  ///< 8 mm from the skin
    tight,  ///< 1 mm from the skin
    drawn,  ///< each hand's own, from the seed: every second one is tight, the others 6 to 12 mm wide
};

/// What hands do over a table.
enum class Gestures {
    all,
    hover,  ///< they move, strike and stop 15 to 200 mm above the surface, and never touch it
    low,    ///< the same 2 to 20 mm above it
};

/// Whether hands touch a table in the scene.
constexpr bool is_table(SimulatedScene scene) { return scene <= SimulatedScene::mixed; }

/// What goes wrong with the simulated camera, seconds after it was opened; negative: never.
struct SimulatorFaults {
    double unplug_s = -1.0;      ///< it is pulled out, for fault_s
    double stall_s = -1.0;       ///< no pictures for fault_s, or until its stream is restarted
    double freeze_s = -1.0;      ///< the same picture again and again, likewise
    double tear_s = -1.0;        ///< one picture whose lower half is the one before
    double tear_every_s = 0.0;   ///< and others so far apart; 0: that one
    double clock_jump_s = -1.0;  ///< the clock goes on an hour later
    double fault_s = 2.0;        ///< how long; 0: until it is restarted
    double every_s =
        0.0;  ///< any of them in turn, drawn from the seed, one in so many seconds on average; 0: none
    bool any() const {
        return unplug_s >= 0 || stall_s >= 0 || freeze_s >= 0 || tear_s >= 0 || clock_jump_s >= 0 ||
               every_s > 0;
    }
};

/// What a sensor URI `sim:SCENE?key=value&key=value` asks for.
struct SimulatorConfig {
    SimulatedScene scene = SimulatedScene::mixed;
    std::uint64_t seed = 1;
    int hands = 1;
    int frames = 0;     ///< 0 = endless
    bool noise = true;  ///< the structured-light sensor model; off gives exact depth
    bool drift = true;  ///< slow column bands; follows `noise` unless the URI names it
    bool human_timing =
        true;  ///< taps as short as those of people (p5/p50/p95 = 36/76/230 ms), else 150 to 300 ms
    Sleeve sleeve = Sleeve::loose;
    Gestures gestures = Gestures::all;
    std::string truth_path;    ///< empty = no truth file
    std::string masks_folder;  ///< empty = no masks
    double height_m = 1.0;     ///< camera above the table
    double tilt_deg = 25.0;    ///< of the optical axis from straight down
    double empty_s = 2.5;      ///< without hands at the start
    double pause_s = 0.0;      ///< between two visits of a hand, on average; 0: 0.6 to 2.5 s
    double rate_hz = 30.0;
    CameraMotion motion = CameraMotion::still;
    double person = 0.0;    ///< somebody walks before the camera of `room` and `wall`, and covers about this
                            ///< share of the pixels; 0 = nobody
    double person_s = 0.0;  ///< when they come in; 0 = they are there from the start
    ObjectKind object = ObjectKind::none;
    double put_s = -1.0;               ///< when the object is set down; negative: it is there from the start
    double take_s = -1.0;              ///< when it is taken hold of; negative: never
    double cycle_s = 0.0;              ///< 0: once; else all of this again after so long
    std::string mesh_path;             ///< of `object`; empty = a bowl
    double size_m = 0.25;              ///< longest side of the object
    bool fingers = false;              ///< two hands hold the object, else it floats
    double distance_m = 0.75;          ///< of the object's middle from the camera
    double knock_s = 5.0;              ///< when the camera is knocked, in one frame step
    double knock_deg = 0.0;            ///< it turns by so much about an axis from the seed
    double knock_mm = 0.0;             ///< and is shifted by so much in a direction from the seed
    bool projector = false;            ///< lights the table with what the program shows
    double projector_moved_mm = 0.0;   ///< to the right, from where the seed hangs it
    bool color = true;                 ///< the camera has a colour picture
    double ambient = 0.3;              ///< light of the room beside it, 0..1
    bool guided = false;               ///< hands touch what they are asked to, and nothing else
    std::string projector_truth_path;  ///< empty = the true projector is not told
    SimulatorFaults faults;
    std::string poses_path;  ///< empty = no poses: the camera's true pose in the scene, a line for each frame
};

/// Reads the part of the URI after `sim:`; an empty scene name means mixed. Throws Error{usage} that names
/// the key and the allowed range.
SimulatorConfig parse_simulator_uri(std::string_view uri_after_scheme);

}  // namespace touchstone
