#include "platform/system/toml_text.hpp"

#include <fmt/format.h>

#include "platform/system/error.hpp"
#include "platform/system/one_line.hpp"

namespace touchstone {

void refuse_toml(const std::string& file, const toml::source_region& where, const std::string& what) {
    throw Error(ExitStatus::configuration, fmt::format("{}:{}: {}", file, where.begin.line, one_line(what)));
}

toml::table parse_toml(std::string_view text, const std::string& file) {
    try {
        return toml::parse(text, file);
    } catch (const toml::parse_error& error) {
        refuse_toml(file, error.source(), std::string(error.description()));
    }
}

}  // namespace touchstone
