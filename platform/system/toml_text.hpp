#pragma once

#include <string>
#include <string_view>
#include <toml++/toml.h>

namespace touchstone {

/// What is wrong with a TOML file and where, as an Error of one line: "FILE:LINE: WHAT".
[[noreturn]] void refuse_toml(const std::string& file, const toml::source_region& where,
                              const std::string& what);

/// The tables in a file's text; throws as refuse_toml() does where it is no TOML.
toml::table parse_toml(std::string_view text, const std::string& file);

}  // namespace touchstone
