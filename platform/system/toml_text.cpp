#include "platform/system/toml_text.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

#include "platform/system/error.hpp"
#include "platform/system/one_line.hpp"

namespace touchstone {

void refuse_toml(const std::string& file, const toml::source_region& where, const std::string& what) {
    throw Error(ExitStatus::configuration, fmt::format("{}:{}: {}", file, where.begin.line, one_line(what)));
}

namespace {

std::string_view line_of(std::string_view text, std::size_t number) {
    for (; number > 1 && !text.empty(); --number)
        text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
    return text.substr(0, text.find('\n'));
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r";
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    return text.substr(0, text.find_last_not_of(blanks) + 1);
}

/// What to write where a text stands without quotes; empty where the line is no such thing.
std::string quotes_advice(std::string_view line) {
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) return {};
    const std::string_view behind = line.substr(equals + 1),
                           value = trimmed(behind.substr(0, behind.find('#')));
    const bool is_text = !value.empty() && (std::isalpha(static_cast<unsigned char>(value[0])) != 0 ||
                                            std::string_view("/.~").find(value[0]) != std::string_view::npos);
    if (!is_text || value == "true" || value == "false") return {};
    return fmt::format("; a text stands in quotes: {} = \"{}\"", trimmed(line.substr(0, equals)), value);
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& file) {
    try {
        return toml::parse(text, file);
    } catch (const toml::parse_error& error) {
        refuse_toml(
            file, error.source(),
            std::string(error.description()) + quotes_advice(line_of(text, error.source().begin.line)));
    }
}

}  // namespace touchstone
