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
};

/// In the order of the menu.
constexpr std::array rows{
    SceneRow{"paint", make<PaintScene>},     SceneRow{"particles", make<ParticlesScene>},
    SceneRow{"mirror", make<MirrorScene>},   SceneRow{"photos", make<PhotosScene>},
    SceneRow{"inspect", make<InspectScene>}, SceneRow{"attract", make<AttractScene>},
};

}  // namespace

std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    names.reserve(rows.size());
    for (const SceneRow& row : rows) names.emplace_back(row.name);
    return names;
}

std::unique_ptr<Scene> make_scene(const std::string& name, const SceneSetup& setup) {
    for (const SceneRow& row : rows)
        if (name == row.name) return row.make(setup);
    std::string known;
    for (const std::string& each : scene_names()) known += (known.empty() ? "" : ", ") + each;
    throw Error(ExitStatus::usage, "No scene is called \"" + name + "\"; choose one of: " + known);
}

}  // namespace touchstone
