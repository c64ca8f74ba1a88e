#include "platform/openni2_drivers/sequence/sequence_folder.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/core.h>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t second_us = 1'000'000;
constexpr std::uint64_t frames_per_second = 30;
constexpr std::uint64_t color_tolerance_us = 20'000;
constexpr int tum_units_per_mm = 5;

/// A name of the first layout: "frame-", six or more digits, a kind that starts with a dot.
struct FrameName {
    int index;
    std::string kind;
};

std::optional<FrameName> parse_frame_name(const std::string& name) {
    constexpr std::string_view prefix = "frame-";
    constexpr std::size_t fewest_digits = 6, most_digits = 9;
    if (!name.starts_with(prefix)) return std::nullopt;
    const std::size_t dot = name.find('.');
    if (dot == std::string::npos || dot < prefix.size() + fewest_digits ||
        dot > prefix.size() + most_digits) {
        return std::nullopt;
    }
    const std::string digits = name.substr(prefix.size(), dot - prefix.size());
    if (!std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; }))
        return std::nullopt;
    return FrameName{std::stoi(digits), name.substr(dot)};
}

std::vector<SequenceEntry> list_numbered(const fs::path& folder) {
    std::map<int, SequenceEntry> entries;
    for (const auto& item : fs::directory_iterator(folder)) {
        const auto name = parse_frame_name(item.path().filename().string());
        if (!name) continue;
        SequenceEntry& entry = entries[name->index];
        if (name->kind == ".depth.png") entry.depth = item.path();
        if (name->kind == ".color.png" || name->kind == ".color.jpg") entry.color = item.path();
        if (name->kind == ".pose.txt") entry.pose = item.path();
    }
    std::vector<SequenceEntry> list;
    for (auto& [index, entry] : entries) {
        if (entry.depth.empty()) continue;
        entry.index = index;
        entry.timestamp_us = static_cast<std::uint64_t>(index) * second_us / frames_per_second;
        list.push_back(std::move(entry));
    }
    return list;
}

struct TimedPath {
    std::uint64_t timestamp_us;
    fs::path path;
};

/// Lines "timestamp_s path", # starts a comment.
std::vector<TimedPath> read_tum_list(const fs::path& list) {
    std::vector<TimedPath> result;
    std::ifstream file(list);
    std::string line;
    for (int number = 1; std::getline(file, line); ++number) {
        std::istringstream words(line.substr(0, line.find('#')));
        double time_s = 0;
        std::string path;
        if ((words >> std::ws).eof()) continue;
        if (!(words >> time_s >> path) || !(time_s >= 0)) {
            throw Error(ExitStatus::bad_data,
                        fmt::format("{}:{}: expected \"timestamp file\"", list.string(), number));
        }
        result.push_back({static_cast<std::uint64_t>(std::llround(time_s * 1e6)), list.parent_path() / path});
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const TimedPath& a, const TimedPath& b) { return a.timestamp_us < b.timestamp_us; });
    return result;
}

std::uint64_t distance_us(std::uint64_t a, std::uint64_t b) { return a > b ? a - b : b - a; }

fs::path nearest_color(const std::vector<TimedPath>& colors, std::uint64_t timestamp_us) {
    const auto nearest =
        std::min_element(colors.begin(), colors.end(), [&](const TimedPath& a, const TimedPath& b) {
            return distance_us(a.timestamp_us, timestamp_us) < distance_us(b.timestamp_us, timestamp_us);
        });
    if (nearest == colors.end() || distance_us(nearest->timestamp_us, timestamp_us) > color_tolerance_us)
        return {};
    return nearest->path;
}

std::vector<SequenceEntry> list_tum(const fs::path& folder) {
    const auto colors = read_tum_list(folder / "rgb.txt");
    std::vector<SequenceEntry> list;
    for (const TimedPath& depth : read_tum_list(folder / "depth.txt")) {
        list.push_back({static_cast<int>(list.size()),
                        depth.timestamp_us,
                        depth.path,
                        nearest_color(colors, depth.timestamp_us),
                        {}});
    }
    return list;
}

}  // namespace

SequenceFolder list_sequence(const fs::path& folder) {
    std::error_code code;
    if (!fs::is_directory(folder, code)) {
        throw Error(ExitStatus::no_input,
                    fmt::format("no folder {}; a sequence is named as seq:DIR", folder.string()));
    }
    SequenceFolder result;
    const bool tum = fs::exists(folder / "depth.txt", code);
    try {
        result.entries = tum ? list_tum(folder) : list_numbered(folder);
    } catch (const fs::filesystem_error& error) {
        throw Error(ExitStatus::no_input,
                    fmt::format("cannot list {}: {}", folder.string(), error.code().message()));
    }
    if (result.entries.empty()) {
        throw Error(
            ExitStatus::no_input,
            fmt::format("no frames in {}: it needs frame-000000.depth.png and so on, or a TUM depth.txt",
                        folder.string()));
    }
    if (tum) result.units_per_mm = tum_units_per_mm;
    if (fs::exists(folder / "camera-intrinsics.txt", code))
        result.intrinsics = folder / "camera-intrinsics.txt";
    return result;
}

}  // namespace touchstone
