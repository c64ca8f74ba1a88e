#include "app/area_scenes.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "platform/system/error.hpp"
#include "ui/scene_list.hpp"

namespace touchstone {

void check_scenes(const std::vector<NamedArea>& areas, const std::string& table_scene, bool on_surface) {
    const std::vector<std::string> known = scene_names(on_surface ? ScenePlace::surface : ScenePlace::screen);
    std::vector<std::string> scenes;
    for (const NamedArea& area : areas) {
        const std::string& scene = scenes.emplace_back(area.scene.empty() ? table_scene : area.scene);
        if (std::ranges::find(known, scene) == known.end())
            throw Error(ExitStatus::configuration,
                        fmt::format("area {}: there is no scene {} here; there are {}", area.name, scene,
                                    fmt::join(known, ", ")));
    }
    if (const std::string conflict = conflict_of(scenes); !conflict.empty())
        throw Error(ExitStatus::configuration, conflict);
}

}  // namespace touchstone
