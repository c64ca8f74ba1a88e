#include "platform/system/temperatures.hpp"

#include <algorithm>
#include <fstream>

namespace touchstone {

std::vector<Temperature> read_temperatures(const std::filesystem::path& thermal) {
    std::vector<Temperature> found;
    std::error_code none;
    for (const auto& zone : std::filesystem::directory_iterator(thermal, none)) {
        if (!zone.path().filename().string().starts_with("thermal_zone")) continue;
        std::string type;
        double millidegrees = 0.0;
        std::ifstream(zone.path() / "type") >> type;
        // A zone that sleeps has no reading.
        if (!(std::ifstream(zone.path() / "temp") >> millidegrees)) continue;
        found.push_back({type.empty() ? zone.path().filename().string() : type, 0.001 * millidegrees});
    }
    std::ranges::sort(found, {}, &Temperature::zone);
    return found;
}

}  // namespace touchstone
