#pragma once

#include <string>
#include <vector>

#include "pipeline/named_areas.hpp"

namespace touchstone {

/// Throws Error{configuration} where a scene is not there for the place, or scenes cannot be there together.
void check_scenes(const std::vector<NamedArea>& areas, const std::string& table_scene, bool on_surface);

}  // namespace touchstone
