#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <sstream>

#include "app/config.hpp"
#include "app/config_paths.hpp"
#include "platform/system/error.hpp"
#include "platform/system/toml_text.hpp"

namespace touchstone {

namespace {

std::string plain_number(double value) { return fmt::format("{:.10g}", value); }

std::string full_name(const ConfigKey& key) { return key.section + "." + key.name; }

std::string allowed(const ConfigKey& key) {
    if (std::holds_alternative<bool*>(key.value)) return full_name(key) + " is true or false";
    if (!key.choices.empty())
        return fmt::format("{} is one of \"{}\"", full_name(key), fmt::join(key.choices, "\", \""));
    if (std::holds_alternative<std::string*>(key.value)) return full_name(key) + " is a text in quotes";
    const char* kind =
        std::holds_alternative<int*>(key.value) ? " is a whole number from " : " is a number from ";
    return full_name(key) + kind + plain_number(key.min) + " to " + plain_number(key.max);
}

std::string text_in_config(const std::string& file, const ConfigKey& key, const std::string& value) {
    switch (key.text) {
        case ConfigKey::Text::path:
            return path_in_config(file, value);
        case ConfigKey::Text::sensor_uri:
            return sensor_uri_in_config(file, value);
        case ConfigKey::Text::any:
            break;
    }
    return value;
}

/// False where the node is of another kind, out of range, or none of the choices.
bool take(const toml::node& node, const ConfigKey& key, const std::string& file) {
    const auto in_range = [&](double value) { return value >= key.min && value <= key.max; };
    if (bool* const* flag = std::get_if<bool*>(&key.value)) {
        const auto value = node.value_exact<bool>();
        if (value) **flag = *value;
        return value.has_value();
    }
    if (std::string* const* text = std::get_if<std::string*>(&key.value)) {
        const auto value = node.value_exact<std::string>();
        if (!value) return false;
        if (!key.choices.empty() && std::ranges::find(key.choices, *value) == key.choices.end()) return false;
        **text = text_in_config(file, key, *value);
        return true;
    }
    if (int* const* whole = std::get_if<int*>(&key.value)) {
        const auto value = node.value_exact<std::int64_t>();
        if (!value || !in_range(static_cast<double>(*value))) return false;
        **whole = static_cast<int>(*value);
        return true;
    }
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value) || !in_range(*value)) return false;
    *std::get<float*>(key.value) = static_cast<float>(*value);
    return true;
}

void take_section(const std::string& section, const toml::table& table, const std::string& file,
                  const std::vector<ConfigKey>& keys) {
    for (const auto& [name, node] : table) {
        const ConfigKey* match = nullptr;
        std::string known;
        for (const ConfigKey& key : keys) {
            if (key.section != section) continue;
            if (!known.empty()) known += ", ";
            known += key.name;
            if (key.name == name.str()) match = &key;
        }
        if (match == nullptr) {
            refuse_toml(
                file, node.source(),
                fmt::format("unknown key {}.{}; [{}] knows: {}", section, name.str(), section, known));
        }
        if (!take(node, *match, file)) refuse_toml(file, node.source(), allowed(*match));
    }
}

std::string known_sections(const std::vector<ConfigKey>& keys) {
    std::string names, last;
    for (const ConfigKey& key : keys) {
        if (key.section == last) continue;
        last = key.section;
        names += (names.empty() ? "" : ", ") + last;
    }
    return names;
}

std::string value_text(const ConfigKey& key) {
    std::ostringstream text;
    if (bool* const* flag = std::get_if<bool*>(&key.value)) text << (**flag ? "true" : "false");
    if (int* const* whole = std::get_if<int*>(&key.value)) text << **whole;
    if (std::string* const* words = std::get_if<std::string*>(&key.value)) {
        text << toml::value<std::string>(**words);
    }
    if (float* const* number = std::get_if<float*>(&key.value)) {
        std::string digits = fmt::format("{}", **number);
        if (digits.find_first_of(".e") == std::string::npos) digits += ".0";
        text << digits;
    }
    return text.str();
}

}  // namespace

void parse_config(const std::string& text, const std::string& file, Config& config) {
    const toml::table root = parse_toml(text, file);
    const std::vector<ConfigKey> keys = config_keys(config);
    for (const auto& [name, node] : root) {
        const std::string section(name.str());
        const bool known =
            std::ranges::any_of(keys, [&](const ConfigKey& key) { return key.section == section; });
        if (!known || !node.is_table()) {
            refuse_toml(file, node.source(),
                        "unknown section " + section + "; there is: " + known_sections(keys));
        }
        take_section(section, *node.as_table(), file, keys);
    }
    if (const auto uri = root.at_path("sensor.uri"))
        config.sensor_named_in = fmt::format("{}:{}", file, uri.node()->source().begin.line);
}

void load_config(const std::string& file, Config& config) {
    std::ifstream stream(file);
    if (!stream)
        throw Error(ExitStatus::no_input,
                    fmt::format("configuration file {} cannot be opened: {}", file, std::strerror(errno)));
    std::ostringstream text;
    text << stream.rdbuf();
    parse_config(text.str(), file, config);
}

std::string print_config(Config config) {
    std::string text, section;
    for (const ConfigKey& key : config_keys(config)) {
        if (key.section != section) text += (section.empty() ? "[" : "\n[") + key.section + "]\n";
        section = key.section;
        std::string note = key.meaning;
        if (key.min < key.max)
            note += (note.empty() ? "" : "; ") + plain_number(key.min) + " to " + plain_number(key.max);
        text += key.name + " = " + value_text(key) + (note.empty() ? "" : "  # " + note) + "\n";
    }
    return text;
}

}  // namespace touchstone
