#include "pipeline/kernel_program.hpp"

#include <stdexcept>
#include <string>

#include "kernel_sources.hpp"

namespace touchstone {

namespace {

ProgramSource embedded(std::string_view name) {
    for (const kernel_sources_file& file : kernel_sources()) {
        if (file.name == name) return {file.path, file.text};
    }
    throw std::logic_error("no kernel file " + std::string(name));
}

}  // namespace

std::vector<ProgramSource> common_kernel_sources() {
    constexpr ProgramSource eight{"", "#define LANES 8\n"}, sixteen{"", "#define LANES 16\n"};
    const ProgramSource lane_math = embedded("lane_math.h");
    return {embedded("shared_types.h"), embedded("device_math.h"), eight, lane_math, sixteen, lane_math,
            embedded("colour_math.h")};
}

Program load_kernel_program(const Device& device, std::string_view stage_file, std::string_view header) {
    std::vector<ProgramSource> sources = common_kernel_sources();
    sources.push_back(embedded("tsdf_access.h"));
    if (!header.empty()) sources.push_back(embedded(header));
    sources.push_back(embedded(stage_file));
    return {device, sources};
}

}  // namespace touchstone
