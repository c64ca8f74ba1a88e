#include "app/config_paths.hpp"

#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace touchstone {

namespace {

namespace fs = std::filesystem;

fs::path folder_of(const std::string& config_file) {
    if (const char* folders = std::getenv("STATE_DIRECTORY")) {
        const std::string_view all = folders;
        return all.substr(0, all.find(':'));
    }
    std::error_code none;
    return fs::absolute(config_file, none).parent_path();
}

}  // namespace

std::string path_in_config(const std::string& config_file, const std::string& path) {
    if (path.empty()) return path;
    const char* const home = std::getenv("HOME");
    if (path.starts_with("~/") && home != nullptr) return (fs::path(home) / path.substr(2)).string();
    return (folder_of(config_file) / path).lexically_normal().string();
}

std::string sensor_uri_in_config(const std::string& config_file, const std::string& uri) {
    constexpr std::string_view sequence = "seq:";
    if (uri.starts_with(sequence))
        return std::string(sequence) + path_in_config(config_file, uri.substr(sequence.size()));
    return uri.ends_with(".oni") ? path_in_config(config_file, uri) : uri;
}

}  // namespace touchstone
