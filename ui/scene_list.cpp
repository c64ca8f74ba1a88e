#include "ui/scene_list.hpp"

#include <array>
#include <type_traits>

#include "platform/system/error.hpp"
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
    const char* name;
    std::unique_ptr<Scene> (*make)(const SceneSetup&);
    bool for_screens_only = false;
};

/// In the order of the menu.
constexpr std::array rows{
    SceneRow{"paint", make<PaintScene>},           SceneRow{"particles", make<ParticlesScene>},
    SceneRow{"mirror", make<MirrorScene>, true},   SceneRow{"photos", make<PhotosScene>},
    SceneRow{"inspect", make<InspectScene>, true}, SceneRow{"attract", make<AttractScene>},
};

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
