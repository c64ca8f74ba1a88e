#include "ui/scene_list.hpp"

#include <array>

#include "platform/system/error.hpp"
#include "ui/scenes/paint.hpp"
#include "ui/scenes/particles.hpp"

namespace touchstone {

namespace {

struct SceneRow {
    const char* name;
    std::unique_ptr<Scene> (*make)();
};

constexpr std::array rows{
    SceneRow{"paint", []() -> std::unique_ptr<Scene> { return std::make_unique<PaintScene>(); }},
    SceneRow{"particles", []() -> std::unique_ptr<Scene> { return std::make_unique<ParticlesScene>(); }},
};

}  // namespace

std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    names.reserve(rows.size());
    for (const SceneRow& row : rows) names.emplace_back(row.name);
    return names;
}

std::unique_ptr<Scene> make_scene(const std::string& name) {
    for (const SceneRow& row : rows)
        if (name == row.name) return row.make();
    std::string known;
    for (const std::string& each : scene_names()) known += (known.empty() ? "" : ", ") + each;
    throw Error(ExitStatus::usage, "No scene is called \"" + name + "\"; choose one of: " + known);
}

}  // namespace touchstone
