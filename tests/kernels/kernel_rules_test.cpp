#include <gtest/gtest.h>
#include <map>
#include <set>
#include <string>

#include "kernel_sources.hpp"
#include "kernels/shared_types.h"
#include "pipeline/kernel_program.hpp"

namespace touchstone {
namespace {

TEST(Kernels, EveryStageBuildsWithoutWarnings) {
    const Device device(DeviceConfig{});
    for (const kernel_sources_file& file : kernel_sources()) {
        if (!file.name.ends_with(".cl")) continue;
        EXPECT_NO_THROW((void)load_kernel_program(device, file.name)) << file.name;
    }
}

TEST(Kernels, SharedStructsHaveTheHostsLayout) {
    const Device device(DeviceConfig{});
    constexpr std::string_view probe = R"(
__kernel void probe(__global int* out, const Pose pose, const VolumeParams volume, const Intrinsics k,
                    const MapShape shape, const FilterParams filter) {
    out[0] = sizeof(Pose); out[1] = sizeof(VolumeParams); out[2] = sizeof(Intrinsics);
    out[3] = sizeof(MapShape); out[4] = sizeof(FilterParams); out[5] = sizeof(SensorNoise);
    out[6] = (int)pose.row_z.w; out[7] = volume.max_weight; out[8] = k.height_px;
    out[9] = shape.rows_px; out[10] = (int)filter.max_depth_m;
})";
    std::string_view shared;
    for (const kernel_sources_file& file : kernel_sources()) {
        if (file.name == "shared_types.h") shared = file.text;
    }
    const std::array<ProgramSource, 2> sources{{{"shared_types.h", shared}, {"probe.cl", probe}}};
    const Program program(device, sources);
    Buffer<int> out(device, 11);
    Pose pose{};
    pose.row_z.w = 3.0f;
    VolumeParams volume{};
    volume.max_weight = 77;
    Intrinsics k{};
    k.height_px = 480;
    FilterParams filter{};
    filter.max_depth_m = 6.0f;
    program.kernel("probe").launch({}, out, pose, volume, k, MapShape{1, 2, 3, 4}, filter);
    const std::vector<int> expected{sizeof(Pose),
                                    sizeof(VolumeParams),
                                    sizeof(Intrinsics),
                                    sizeof(MapShape),
                                    sizeof(FilterParams),
                                    sizeof(SensorNoise),
                                    3,
                                    77,
                                    480,
                                    4,
                                    6};
    EXPECT_EQ(out.read(), expected);
}

/// The numbers n of all marks `L2:n`.
std::multiset<int> marked_lines(const std::string& text) {
    std::multiset<int> lines;
    for (std::size_t colon = text.find(':'); colon != std::string::npos; colon = text.find(':', colon + 1)) {
        const bool marked = colon >= 2 && text[colon - 2] == 'L' && std::isdigit(text[colon - 1]) != 0;
        if (marked && colon + 1 < text.size() && std::isdigit(text[colon + 1]) != 0)
            lines.insert(std::stoi(text.substr(colon + 1)));
    }
    return lines;
}

/// Lines of the paper's listings that a kernel or the host does, as `L2:7`. Lines that only open a loop or a
/// branch are the launch itself.
TEST(Kernels, EveryListingLineIsMarkedOnce) {
    const std::map<std::string, std::set<int>> wanted{
        {"listing_1_data_association.cl", {1, 2, 3, 4, 5, 6, 7, 8, 9}},
        {"listing_2_tsdf_integration.cl", {3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14}},
        {"listing_3_raycast.cl", {1, 2, 3, 4, 5, 6, 9, 10, 11, 12, 13, 14, 15, 16}},
        {"listing_4_touch_map.cl", {1, 2, 3, 4, 5, 6, 7}},
        {"shading.cl", {17}}};
    std::set<std::string> seen;
    for (const kernel_sources_file& file : kernel_sources()) {
        const auto listing = wanted.find(std::string(file.name));
        if (listing == wanted.end()) continue;
        seen.insert(listing->first);
        const std::string text(file.text);
        const std::multiset<int> found = marked_lines(text);
        for (const int line : listing->second)
            EXPECT_EQ(found.count(line), 1u) << file.name << " line " << line;
    }
    EXPECT_EQ(seen.size(), wanted.size());
}

}  // namespace
}  // namespace touchstone
