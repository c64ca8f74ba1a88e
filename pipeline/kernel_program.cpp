#include "pipeline/kernel_program.hpp"

#include <array>
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

Program load_kernel_program(const Device& device, std::string_view stage_file) {
    const std::array sources{embedded("shared_types.h"), embedded("device_math.h"), embedded("tsdf_access.h"),
                             embedded(stage_file)};
    return {device, sources};
}

}  // namespace touchstone
