#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ui/scene.hpp"
#include "ui/scene_setup.hpp"

namespace touchstone {

std::vector<std::string> scene_names();

/// Throws Error{usage}, listing the names, when there is no scene of that name.
std::unique_ptr<Scene> make_scene(const std::string& name, const SceneSetup& setup = {});

}  // namespace touchstone
