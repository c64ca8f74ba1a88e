#include "ui/scene_list.hpp"

#include <algorithm>
#include <array>
#include <type_traits>

#include "platform/system/error.hpp"
#include "ui/scene_names.hpp"
#include "ui/scenes/attract.hpp"
#include "ui/scenes/inspect.hpp"
#include "ui/scenes/mirror.hpp"
#include "ui/scenes/paint.hpp"
#include "ui/scenes/particles.hpp"
#include "ui/scenes/photos.hpp"

namespace touchstone {

namespace {

template <class Made>
std::unique_ptr<Scene> make(const SceneSetup& setup) {
    if constexpr (std::is_constructible_v<Made, const SceneSetup&>)
        return std::make_unique<Made>(setup);
    else
        return std::make_unique<Made>();
}

struct SceneRow {
    std::string_view name;
    std::unique_ptr<Scene> (*make)(const SceneSetup&);
    bool for_screens_only = false;
    bool wants_view = false, wants_particles = false;
};

/// In the order of the menu.
constexpr std::array rows{
    SceneRow{.name = "paint", .make = make<PaintScene>},
    SceneRow{.name = "particles", .make = make<ParticlesScene>, .wants_particles = true},
    SceneRow{.name = "mirror", .make = make<MirrorScene>, .for_screens_only = true, .wants_view = true},
    SceneRow{.name = "photos", .make = make<PhotosScene>},
    SceneRow{.name = "inspect", .make = make<InspectScene>, .for_screens_only = true, .wants_view = true},
    SceneRow{.name = "attract", .make = make<AttractScene>},
};

static_assert(std::ranges::equal(rows, all_scene_names, {}, &SceneRow::name));

bool is_for(const SceneRow& row, ScenePlace place) {
    return place == ScenePlace::screen || !row.for_screens_only;
}

}  // namespace

std::vector<std::string> scene_names(ScenePlace place) {
    std::vector<std::string> names;
    names.reserve(rows.size());
    for (const SceneRow& row : rows)
        if (is_for(row, place)) names.emplace_back(row.name);
    return names;
}

std::string conflict_of(std::span<const std::string> scenes) {
    for (const auto wants : {&SceneRow::wants_view, &SceneRow::wants_particles}) {
        const std::string* first = nullptr;
        for (const std::string& scene : scenes) {
            if (!std::ranges::any_of(rows,
                                     [&](const SceneRow& row) { return scene == row.name && row.*wants; }))
                continue;
            if (first != nullptr && *first == scene) return "The scene " + scene + " can be in one area only";
            if (first != nullptr)
                return "The scenes " + *first + " and " + scene + " cannot be in two areas at once";
            first = &scene;
        }
    }
    return {};
}

std::unique_ptr<Scene> make_scene(const std::string& name, const SceneSetup& setup, ScenePlace place) {
    std::string fault = "No scene is called \"" + name + "\"";
    for (const SceneRow& row : rows) {
        if (name != row.name) continue;
        if (is_for(row, place)) return row.make(setup);
        fault = "The scene \"" + name + "\" is for screens, not for a projector";
    }
    std::string known;
    for (const std::string& each : scene_names(place)) known += (known.empty() ? "" : ", ") + each;
    throw Error(ExitStatus::usage, fault + "; choose one of: " + known);
}

}  // namespace touchstone
