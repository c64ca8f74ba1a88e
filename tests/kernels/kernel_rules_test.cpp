#include <array>
#include <cstddef>
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

std::string_view shared_types() {
    for (const kernel_sources_file& file : kernel_sources()) {
        if (file.name == "shared_types.h") return file.text;
    }
    return {};
}

struct Field {
    std::string type, name;
    int size = 0, offset = 0;
};

#define FIELD(Type, name) \
    { #Type, #name, sizeof(Type), offsetof(Type, name) }

/// Of each shared struct the fields after which a layout can go astray: behind nested structs and vectors,
/// and the last.
std::vector<Field> shared_fields() {
    return {FIELD(Intrinsics, width_px),
            FIELD(Intrinsics, reserved),
            FIELD(Pose, row_y),
            FIELD(Pose, row_z),
            FIELD(SensorNoise, grazing),
            FIELD(MapShape, rows_px),
            FIELD(FilterParams, spatial_sigma_px),
            FIELD(FilterParams, max_depth_m),
            FIELD(VolumeParams, size_vox),
            FIELD(VolumeParams, max_weight),
            FIELD(VolumeParams, reserved),
            FIELD(SampleWeightParams, reference_sigma_m),
            FIELD(SampleWeightParams, most),
            FIELD(ColorParams, band_vox),
            FIELD(ColorParams, guard_px),
            FIELD(AdaptiveWeightParams, calm_sigmas),
            FIELD(AdaptiveWeightParams, least_weight),
            FIELD(TouchMapParams, finger_thickness_m),
            FIELD(TouchMapParams, reserved),
            FIELD(AssociationParams, quantisation_per_m),
            FIELD(AssociationParams, min_normal_cos),
            FIELD(CandidateParams, quantisation_per_m),
            FIELD(CandidateParams, unknown_depth_m),
            FIELD(DriftParams, first_row),
            FIELD(DriftParams, reserved),
            FIELD(ConnectionParams, gap_sigmas),
            FIELD(ConnectionParams, gap_per_m),
            FIELD(ComponentSums, min_x),
            FIELD(ComponentSums, expected),
            FIELD(ShadingParams, foreground),
            FIELD(ShadingParams, light_c),
            FIELD(ViewLightingParams, up_g),
            FIELD(ViewLightingParams, mesh_step),
            FIELD(ViewLightingParams, reserved),
            FIELD(AlignmentParams, centre_p),
            FIELD(AlignmentParams, max_distance_m),
            FIELD(AlignmentParams, reference_sigma_m),
            FIELD(AlignmentParams, reserved),
            FIELD(ParticleParams, radius_m),
            FIELD(ParticleParams, reserved)};
}

#undef FIELD

TEST(Kernels, SharedStructsHaveTheHostsLayout) {
    const Device device(DeviceConfig{});
    const std::vector<Field> fields = shared_fields();
    std::string probe = "__kernel void probe(__global int* out) {\n";
    std::vector<int> expected;
    for (const Field& field : fields) {
        const std::string at = std::to_string(expected.size());
        probe += "out[" + at + "] = (int)sizeof(" + field.type + ");\nout[" + at +
                 " + 1] = (int)(size_t)&((__global " + field.type + "*)0)->" + field.name + ";\n";
        expected.insert(expected.end(), {field.size, field.offset});
    }
    probe += "}\n";
    const std::array<ProgramSource, 2> sources{{{"shared_types.h", shared_types()}, {"probe.cl", probe}}};
    const Program program(device, sources);
    Buffer<int> out(device, expected.size());
    program.kernel("probe").launch({}, out);
    const std::vector<int> got = out.read();
    for (std::size_t i = 0; i < fields.size(); ++i) {
        EXPECT_EQ(got[2 * i], expected[2 * i]) << "size of " << fields[i].type;
        EXPECT_EQ(got[2 * i + 1], expected[2 * i + 1]) << fields[i].type << "." << fields[i].name;
    }
}

TEST(Kernels, EverySharedStructIsProbed) {
    std::set<std::string> probed;
    for (const Field& field : shared_fields()) probed.insert(field.type);
    const std::string text(shared_types());
    const std::string declaration = "typedef struct ";
    int found = 0;
    for (std::size_t at = text.find(declaration); at != std::string::npos;
         at = text.find(declaration, at + 1)) {
        const std::size_t first = at + declaration.size();
        const std::string name = text.substr(first, text.find(' ', first) - first);
        ++found;
        EXPECT_TRUE(probed.contains(name)) << name << " is not in shared_fields()";
    }
    EXPECT_EQ(found, static_cast<int>(probed.size()));
}

/// Scalars and vectors handed over by value arrive as they are.
TEST(Kernels, StructsPassedByValueArrive) {
    const Device device(DeviceConfig{});
    constexpr std::string_view probe = R"(
__kernel void probe(__global int* out, const Pose pose, const VolumeParams volume, const AlignmentParams alignment) {
    out[0] = (int)pose.row_z.w; out[1] = volume.max_weight; out[2] = (int)alignment.reference_sigma_m;
})";
    const std::array<ProgramSource, 2> sources{{{"shared_types.h", shared_types()}, {"probe.cl", probe}}};
    const Program program(device, sources);
    Buffer<int> out(device, 3);
    Pose pose{};
    pose.row_z.w = 3.0f;
    VolumeParams volume{};
    volume.max_weight = 77;
    AlignmentParams alignment{};
    alignment.reference_sigma_m = 6.0f;
    program.kernel("probe").launch({}, out, pose, volume, alignment);
    EXPECT_EQ(out.read(), (std::vector<int>{3, 77, 6}));
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
        {"shading.cl", {17}},
        {"view_lighting.cl", {7, 8, 18, 19, 20, 21}}};
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
