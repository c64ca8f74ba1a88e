#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace touchstone {

struct Temperature {
    std::string zone;  ///< as the kernel calls it, e.g. x86_pkg_temp, cpu-thermal
    double celsius = 0.0;
};

/// The thermal zones of the machine; empty where the kernel shows none.
std::vector<Temperature> read_temperatures(const std::filesystem::path& thermal = "/sys/class/thermal");

}  // namespace touchstone
