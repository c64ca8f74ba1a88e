#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/named_areas.hpp"

namespace touchstone {

/// Named areas as TOML text that people may write, too; area = [] is a table that is one:
///   [[area]]
///   name = "left"
///   scene = "paint"              # optional
///   source = "left@table"        # of TUIO, optional
///   corners_mm = [[-300, -200], [0, -200], [0, 200], [-300, 200]]
/// Throws Error{configuration} with `name`, line and what is allowed.
std::vector<NamedArea> parse_areas(std::string_view text, const std::string& name);

/// Of a file; where that is damaged or wrong it is said, and the one before it counts, if that is whole.
/// Throws Error{no_input} where it cannot be read, Error{configuration} as parse_areas.
std::vector<NamedArea> load_areas(const std::filesystem::path& path);

/// Whole or not at all; the file before it is kept, unless it is wrong and there is a right one before it.
/// Throws Error{io_error}.
void save_areas(const std::filesystem::path& path, const std::vector<NamedArea>& areas);

}  // namespace touchstone
