#pragma once

#include <string>
#include <vector>

#include "pipeline/named_areas.hpp"

namespace touchstone {

/// Throws Error{configuration} where a scene is not there for the place, or scenes cannot be there together.
void check_scenes(const std::vector<NamedArea>& areas, const std::string& table_scene, bool on_surface);

/// The areas of a file. Throws as load_areas() and, with the file's name, as check_scenes() do.
std::vector<NamedArea> load_areas_with_scenes(const std::string& file, const std::string& table_scene,
                                              bool on_surface);

/// For people: "left (paint), right (photos)".
std::string told(const std::vector<NamedArea>& areas, const std::string& table_scene);

}  // namespace touchstone
