#include "tests/house/house_rules.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <fstream>
#include <iterator>
#include <regex>

namespace touchstone {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string_view> product_folders = {"app", "platform", "pipeline", "ui", "kernels"};

std::string text_of(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines(1);
    for (const char c : text) {
        if (c == '\n') {
            lines.emplace_back();
        } else {
            lines.back().push_back(c);
        }
    }
    if (lines.back().empty()) lines.pop_back();
    return lines;
}

/// "ui" for ui/scenes/paint.cpp, "platform/usb" for platform/usb/hot_plug.hpp.
std::string part_of(const std::string& path) {
    const std::size_t first = path.find('/');
    if (path.substr(0, first) != "platform") return path.substr(0, first);
    return path.substr(0, path.find('/', first + 1));
}

/// What a part may include beside itself: whole parts, or single files.
std::vector<std::string> allowed_for(const std::string& part) {
    if (part == "app") return {"ui", "pipeline", "platform", "kernels/shared_types.h"};
    if (part == "ui") {
        return {"platform/display",
                "platform/system",
                "pipeline/types.hpp",
                "pipeline/touch_event.hpp",
                "pipeline/particle_view.hpp",
                "pipeline/scene_wish.hpp",
                "pipeline/projector_model.hpp",
                "pipeline/surface_grid.hpp",
                "kernels/shared_types.h"};
    }
    if (part == "pipeline") return {"platform/opencl", "platform/system", "kernels"};
    if (part == "kernels" || part == "platform/system") return {};
    if (part == "platform/openni2_drivers")
        return {"platform/system", "platform/image", "platform/mesh", "kernels/shared_types.h"};
    // What the drivers and the camera agree on: pace and the custom device properties.
    if (part == "platform/camera")
        return {"platform/system", "platform/openni2_drivers/common", "kernels/shared_types.h"};
    return {"platform/system", "kernels/shared_types.h"};
}

bool is_below(const std::string& path, const std::string& folder) {
    return path == folder || path.starts_with(folder + "/");
}

bool may_include(const std::string& file, const std::string& included) {
    const std::string part = part_of(file);
    if (is_below(included, part)) return true;
    const auto allowed = allowed_for(part);
    return std::any_of(allowed.begin(), allowed.end(),
                       [&](const std::string& folder) { return is_below(included, folder); });
}

/// Blanks comments, keeping the line breaks.
std::string without_comments(const std::string& text) {
    std::string code;
    for (std::size_t i = 0; i < text.size();) {
        if (text.compare(i, 2, "//") == 0) {
            i = std::min(text.find('\n', i), text.size());
        } else if (text.compare(i, 2, "/*") == 0) {
            const std::size_t end = std::min(text.find("*/", i + 2), text.size() - 2) + 2;
            code.append(
                static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(i),
                                                    text.begin() + static_cast<std::ptrdiff_t>(end), '\n')),
                '\n');
            i = end;
        } else {
            code.push_back(text[i++]);
        }
    }
    return code;
}

struct Ban {
    const char* pattern;
    const char* reason;
};
constexpr Ban bans[] = {
    {R"(\bimage\w+_t\b|\bsampler_t\b|\b(read|write)_image)", "images are not for every device"},
    {R"(\bhalf\d*\b|\bv(load|store)a?_half|cl_khr_fp16)", "half is not for every device"},
    {R"(\bdouble\d*\b|cl_khr_fp64)", "double is not for every device"},
    {R"(\w*sub_group\w*)", "subgroups are not of OpenCL C 1.2"},
    {R"(\bwork_group_(all|any|broadcast|reduce|scan)\w*)", "work-group functions are of OpenCL C 2"},
    {R"(\batomic_(load|store|fetch|exchange|compare_exchange|init|flag)\w*|\bmemory_order)",
     "these atomics are of OpenCL C 2"},
};

int group_size(const std::string& line) {
    static const std::regex attribute(
        R"(work_group_size(?:_hint)?\s*\(\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*\))");
    std::smatch found;
    if (!std::regex_search(line, found, attribute)) return 0;
    return std::stoi(found[1]) * std::stoi(found[2]) * std::stoi(found[3]);
}

std::string place(const fs::path& path, const fs::path& root, std::size_t line) {
    return fmt::format("{}:{}", fs::relative(path, root).generic_string(), line + 1);
}

}  // namespace

std::vector<fs::path> source_files(const fs::path& root, const std::vector<std::string_view>& folders,
                                   const std::vector<std::string_view>& endings) {
    std::vector<fs::path> files;
    for (const std::string_view folder : folders) {
        if (!fs::exists(root / folder)) continue;
        for (auto entry = fs::recursive_directory_iterator(root / folder); entry != fs::end(entry); ++entry) {
            const std::string name = entry->path().filename().string();
            if (name == "build" || name == "node_modules") entry.disable_recursion_pending();
            const std::string ending = entry->path().extension().string();
            const bool wanted = std::find(endings.begin(), endings.end(), ending) != endings.end();
            if (entry->is_regular_file() && wanted) files.push_back(entry->path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

Breaches include_direction_breaches(const fs::path& root) {
    static const std::regex include(R"rx(^\s*#\s*include\s*"([^"]+)")rx");
    Breaches breaches;
    for (const fs::path& path : source_files(root, product_folders, {".cpp", ".hpp", ".h", ".cl"})) {
        const std::string file = fs::relative(path, root).generic_string();
        const auto lines = lines_of(text_of(path));
        for (std::size_t i = 0; i < lines.size(); ++i) {
            std::smatch found;
            if (!std::regex_search(lines[i], found, include)) continue;
            const std::string included = found[1];
            const bool is_generated_or_foreign =
                included.find('/') == std::string::npos && !fs::exists(path.parent_path() / included);
            if (is_generated_or_foreign || may_include(file, included)) continue;
            breaches.push_back(
                fmt::format("{}: {} must not include \"{}\"", place(path, root, i), part_of(file), included));
        }
    }
    return breaches;
}

Breaches kernel_language_breaches(const fs::path& root) {
    Breaches breaches;
    for (const fs::path& path : source_files(root, {"kernels"}, {".cl", ".h"})) {
        const auto lines = lines_of(without_comments(text_of(path)));
        for (std::size_t i = 0; i < lines.size(); ++i) {
            for (const Ban& ban : bans) {
                std::smatch found;
                if (!std::regex_search(lines[i], found, std::regex(ban.pattern))) continue;
                breaches.push_back(
                    fmt::format("{}: {}: {}", place(path, root, i), found[0].str(), ban.reason));
            }
            if (group_size(lines[i]) > 256) {
                breaches.push_back(
                    fmt::format("{}: a group of {} work-items", place(path, root, i), group_size(lines[i])));
            }
        }
    }
    return breaches;
}

Breaches file_length_breaches(const fs::path& root, std::size_t most) {
    Breaches breaches;
    for (const fs::path& path : source_files(root, product_folders, {".cpp", ".hpp", ".h", ".cl"})) {
        const std::size_t lines = lines_of(text_of(path)).size();
        if (lines <= most) continue;
        breaches.push_back(
            fmt::format("{}: {} lines, at most {}", fs::relative(path, root).generic_string(), lines, most));
    }
    return breaches;
}

}  // namespace touchstone
