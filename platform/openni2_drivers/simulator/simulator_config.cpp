#include "platform/openni2_drivers/simulator/simulator_config.hpp"

#include <array>
#include <charconv>
#include <fmt/core.h>
#include <optional>
#include <utility>

#include "platform/system/error.hpp"
#include "platform/system/one_line.hpp"

namespace touchstone {
namespace {

constexpr std::string_view key_names =
    "seed, hands, frames, noise, drift, human, sleeve, gestures, truth, masks, height, tilt, empty, pause, "
    "rate, "
    "poses, motion, "
    "person, person_s, mesh, size_m, grip, distance, object, put_s, take_s, cycle_s, knock_s, knock_deg, "
    "knock_mm, unplug_at, stall_at, freeze_at, tear, tear_every, clock_jump, fault_s, faults_every, "
    "projector, ambient, guided, projector_truth, projector_moved_mm, color";

[[noreturn]] void refuse(const std::string& message) {
    throw Error(ExitStatus::usage, "sensor URI sim: " + one_line(message));
}

template <class Value, std::size_t count>
using Names = std::array<std::pair<std::string_view, Value>, count>;

template <class Value, std::size_t count>
std::optional<Value> find_name(const Names<Value, count>& names, std::string_view name) {
    for (const auto& [known, value] : names)
        if (known == name) return value;
    return std::nullopt;
}

SimulatedScene parse_scene(std::string_view name) {
    constexpr Names<SimulatedScene, 9> scenes{{
        {"", SimulatedScene::mixed},
        {"flat", SimulatedScene::flat},
        {"curved", SimulatedScene::curved},
        {"cluttered", SimulatedScene::cluttered},
        {"bowl", SimulatedScene::bowl},
        {"mixed", SimulatedScene::mixed},
        {"room", SimulatedScene::room},
        {"wall", SimulatedScene::wall},
        {"object", SimulatedScene::object},
    }};
    if (const auto scene = find_name(scenes, name)) return *scene;
    refuse(fmt::format("unknown scene '{}'; use flat, curved, cluttered, bowl, mixed, room, wall or object",
                       name));
}

CameraMotion parse_motion(std::string_view name) {
    constexpr Names<CameraMotion, 5> motions{{
        {"still", CameraMotion::still},
        {"sweep", CameraMotion::sweep},
        {"orbit", CameraMotion::orbit},
        {"rpy", CameraMotion::rpy},
        {"slide", CameraMotion::slide},
    }};
    if (const auto motion = find_name(motions, name)) return *motion;
    refuse(fmt::format("key motion must be still, sweep, orbit, rpy or slide, not '{}'", name));
}

bool parse_grip(std::string_view name) {
    if (name == "none" || name == "fingers") return name == "fingers";
    refuse(fmt::format("key grip must be none or fingers, not '{}'", name));
}

ObjectKind parse_object(std::string_view name) {
    constexpr Names<ObjectKind, 5> kinds{{
        {"none", ObjectKind::none},
        {"box", ObjectKind::box},
        {"ball", ObjectKind::ball},
        {"can", ObjectKind::can},
        {"book", ObjectKind::book},
    }};
    if (const auto kind = find_name(kinds, name)) return *kind;
    refuse(fmt::format("key object must be none, box, ball, can or book, not '{}'", name));
}

Sleeve parse_sleeve(std::string_view name) {
    constexpr Names<Sleeve, 3> sleeves{
        {{"loose", Sleeve::loose}, {"tight", Sleeve::tight}, {"drawn", Sleeve::drawn}}};
    if (const auto sleeve = find_name(sleeves, name)) return *sleeve;
    refuse(fmt::format("key sleeve must be loose, tight or drawn, not '{}'", name));
}

Gestures parse_gestures(std::string_view name) {
    constexpr Names<Gestures, 3> kinds{
        {{"all", Gestures::all}, {"hover", Gestures::hover}, {"low", Gestures::low}}};
    if (const auto gestures = find_name(kinds, name)) return *gestures;
    refuse(fmt::format("key gestures must be all, hover or low, not '{}'", name));
}

/// What the keys of the object say together.
void check_object(const SimulatorConfig& config) {
    constexpr double visit_s = 1.5;  // a hand's way in or out, with the moment it holds the object
    const bool timed = config.put_s >= 0.0 || config.take_s >= 0.0 || config.cycle_s > 0.0;
    if (timed && config.object == ObjectKind::none)
        refuse("keys put_s, take_s and cycle_s need an object: object=box, ball, can or book");
    if (config.take_s >= 0.0 && config.take_s < config.put_s + 2.0 * visit_s && config.put_s >= 0.0)
        refuse(fmt::format("key take_s must be at least put_s + {}", 2.0 * visit_s));
    if (config.cycle_s > 0.0 &&
        (config.put_s < visit_s || config.take_s < 0.0 || config.cycle_s < config.take_s + visit_s))
        refuse(fmt::format("key cycle_s needs put_s of at least {}, take_s, and must be at least take_s + {}",
                           visit_s, visit_s));
    if (config.hands > 0 && config.put_s >= 0.0 && config.empty_s < config.put_s + visit_s)
        refuse(fmt::format(
            "key empty must be at least put_s + {}: hands must not touch what is not there yet", visit_s));
    if (config.take_s >= 0.0 && config.hands > 0)
        refuse("key take_s needs hands=0: hands would touch what is no longer there");
}

void check_projector(const SimulatorConfig& config) {
    if (config.projector) return;
    if (config.guided) refuse("key guided needs projector=1: hands touch what it shows");
    if (!config.projector_truth_path.empty()) refuse("key projector_truth needs projector=1");
    if (config.projector_moved_mm != 0.0) refuse("key projector_moved_mm needs projector=1");
}

/// Whether a key says anything about a scene of this kind.
bool applies(std::string_view key, SimulatedScene scene) {
    const bool object = scene == SimulatedScene::object;
    for (const std::string_view of_tables :
         {"hands", "human", "sleeve", "gestures", "truth", "height", "tilt", "empty", "pause", "object",
          "put_s", "take_s", "cycle_s", "projector", "ambient", "guided", "projector_truth"})
        if (key == of_tables) return is_table(scene);
    for (const std::string_view of_objects : {"mesh", "size_m", "grip", "distance"})
        if (key == of_objects) return object;
    if (key == "motion" || key == "person" || key == "person_s") return !is_table(scene) && !object;
    return true;
}

template <class Number>
Number parse_number(std::string_view key, std::string_view value, Number least, Number most) {
    Number number{};
    const auto [end, status] = std::from_chars(value.data(), value.data() + value.size(), number);
    const bool whole = status == std::errc{} && end == value.data() + value.size();
    // Written so that a NaN is refused.
    if (whole && number >= least && number <= most) return number;
    refuse(fmt::format("key {} must be a number from {} to {}, not '{}'", key, least, most, value));
}

bool parse_switch(std::string_view key, std::string_view value) {
    if (value == "0" || value == "1") return value == "1";
    refuse(fmt::format("key {} must be 0 or 1, not '{}'", key, value));
}

std::string parse_path(std::string_view key, std::string_view value) {
    if (value.empty()) refuse(fmt::format("key {} needs a path", key));
    return std::string(value);
}

struct Parsed {
    SimulatorConfig config;
    std::optional<bool> drift;
};

bool set_switch(Parsed& parsed, std::string_view key, std::string_view value) {
    if (key == "noise")
        parsed.config.noise = parse_switch(key, value);
    else if (key == "drift")
        parsed.drift = parse_switch(key, value);
    else if (key == "human")
        parsed.config.human_timing = parse_switch(key, value);
    else if (key == "projector")
        parsed.config.projector = parse_switch(key, value);
    else if (key == "color")
        parsed.config.color = parse_switch(key, value);
    else if (key == "guided")
        parsed.config.guided = parse_switch(key, value);
    else
        return false;
    return true;
}

bool set_number(SimulatorConfig& config, std::string_view key, std::string_view value) {
    if (key == "seed")
        config.seed = parse_number<std::uint64_t>(key, value, 0, 0xffff'ffffU);
    else if (key == "hands")
        config.hands = parse_number(key, value, 0, 2);
    else if (key == "frames")
        config.frames = parse_number(key, value, 0, 100'000'000);
    else if (key == "height")
        config.height_m = parse_number(key, value, 0.5, 1.6);
    else if (key == "tilt")
        config.tilt_deg = parse_number(key, value, 0.0, 45.0);
    else if (key == "empty")
        config.empty_s = parse_number(key, value, 0.0, 3600.0);
    else if (key == "pause")
        config.pause_s = parse_number(key, value, 0.0, 3600.0);
    else if (key == "rate")
        config.rate_hz = parse_number(key, value, 1.0, 120.0);
    else if (key == "ambient")
        config.ambient = parse_number(key, value, 0.0, 1.0);
    else if (key == "person")
        config.person = parse_number(key, value, 0.0, 0.6);
    else if (key == "person_s")
        config.person_s = parse_number(key, value, 0.0, 3600.0);
    else if (key == "size_m")
        config.size_m = parse_number(key, value, 0.02, 0.5);
    else if (key == "distance")
        config.distance_m = parse_number(key, value, 0.5, 1.5);
    else if (key == "projector_moved_mm")
        config.projector_moved_mm = parse_number(key, value, -500.0, 500.0);
    else if (key == "knock_s")
        config.knock_s = parse_number(key, value, 0.0, 3600.0);
    else if (key == "knock_deg")
        config.knock_deg = parse_number(key, value, 0.0, 180.0);
    else if (key == "knock_mm")
        config.knock_mm = parse_number(key, value, 0.0, 10000.0);
    else
        return false;
    return true;
}

bool set_fault(SimulatorFaults& faults, std::string_view key, std::string_view value) {
    const Names<double*, 8> seconds{{{"unplug_at", &faults.unplug_s},
                                     {"stall_at", &faults.stall_s},
                                     {"freeze_at", &faults.freeze_s},
                                     {"tear", &faults.tear_s},
                                     {"tear_every", &faults.tear_every_s},
                                     {"clock_jump", &faults.clock_jump_s},
                                     {"fault_s", &faults.fault_s},
                                     {"faults_every", &faults.every_s}}};
    const auto target = find_name(seconds, key);
    if (target) **target = parse_number(key, value, 0.0, 3600.0);
    return target.has_value();
}

bool set_object(SimulatorConfig& config, std::string_view key, std::string_view value) {
    if (key == "object")
        config.object = parse_object(value);
    else if (key == "put_s")
        config.put_s = parse_number(key, value, 0.0, 3600.0);
    else if (key == "take_s")
        config.take_s = parse_number(key, value, 0.0, 3600.0);
    else if (key == "cycle_s")
        config.cycle_s = parse_number(key, value, 0.0, 3600.0);
    else
        return false;
    return true;
}

bool set_text(SimulatorConfig& config, std::string_view key, std::string_view value) {
    if (key == "truth")
        config.truth_path = parse_path(key, value);
    else if (key == "masks")
        config.masks_folder = parse_path(key, value);
    else if (key == "poses")
        config.poses_path = parse_path(key, value);
    else if (key == "projector_truth")
        config.projector_truth_path = parse_path(key, value);
    else if (key == "motion")
        config.motion = parse_motion(value);
    else if (key == "mesh")
        config.mesh_path = parse_path(key, value);
    else if (key == "sleeve")
        config.sleeve = parse_sleeve(value);
    else if (key == "gestures")
        config.gestures = parse_gestures(value);
    else if (key == "grip")
        config.fingers = parse_grip(value);
    else
        return false;
    return true;
}

void set_pair(Parsed& parsed, std::string_view pair, std::string_view scene) {
    const std::size_t equals = pair.find('=');
    if (equals == std::string_view::npos) refuse(fmt::format("'{}' is not of the form key=value", pair));
    const std::string_view key = pair.substr(0, equals);
    const std::string_view value = pair.substr(equals + 1);
    if (!applies(key, parsed.config.scene)) refuse(fmt::format("key {} is not for the scene {}", key, scene));
    if (set_switch(parsed, key, value) || set_number(parsed.config, key, value) ||
        set_object(parsed.config, key, value) || set_fault(parsed.config.faults, key, value) ||
        set_text(parsed.config, key, value))
        return;
    refuse(fmt::format("unknown key '{}'; the keys are {}", key, key_names));
}

}  // namespace

SimulatorConfig parse_simulator_uri(std::string_view uri_after_scheme) {
    const std::size_t question = uri_after_scheme.find('?');
    Parsed parsed;
    const std::string_view scene = uri_after_scheme.substr(0, question);
    parsed.config.scene = parse_scene(scene);
    std::string_view rest =
        question == std::string_view::npos ? std::string_view{} : uri_after_scheme.substr(question + 1);
    while (!rest.empty()) {
        const std::size_t end = rest.find('&');
        set_pair(parsed, rest.substr(0, end), scene);
        rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
    }
    check_object(parsed.config);
    check_projector(parsed.config);
    parsed.config.drift = parsed.drift.value_or(parsed.config.noise);
    return parsed.config;
}

}  // namespace touchstone
