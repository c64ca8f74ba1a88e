#include "app/area_scenes.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "app/areas_file.hpp"
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

std::vector<NamedArea> load_areas_with_scenes(const std::string& file, const std::string& table_scene,
                                              bool on_surface) {
    std::vector<NamedArea> areas = load_areas(file);
    try {
        check_scenes(areas, table_scene, on_surface);
    } catch (const Error& error) {
        throw Error(error.status(), fmt::format("{}: {}", file, error.what()));
    }
    return areas;
}

std::string told(const std::vector<NamedArea>& areas, const std::string& table_scene) {
    std::string text;
    for (const NamedArea& area : areas)
        text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", area.name,
                            area.scene.empty() ? table_scene : area.scene);
    return text;
}

}  // namespace touchstone
