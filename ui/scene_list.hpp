#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ui/scene.hpp"
#include "ui/scene_setup.hpp"

namespace touchstone {

/// Scenes whose picture is the depth camera's view of the table are for screens: a projector has the table.
enum class ScenePlace { screen, surface };

std::vector<std::string> scene_names(ScenePlace place = ScenePlace::screen);

/// Why these scenes cannot be on the table at once, each in an area of its own; empty where they can.
/// Pictures of the scan and particles are made for one.
std::string conflict_of(std::span<const std::string> scenes);

/// Throws Error{usage}, listing the names, when there is no scene of that name in that place.
std::unique_ptr<Scene> make_scene(const std::string& name, const SceneSetup& setup = {},
                                  ScenePlace place = ScenePlace::screen);

}  // namespace touchstone
