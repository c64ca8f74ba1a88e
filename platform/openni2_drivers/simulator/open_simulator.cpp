#include "platform/openni2_drivers/simulator/mesh_source.hpp"
#include "platform/openni2_drivers/simulator/simulator_source.hpp"

namespace touchstone {

std::unique_ptr<FrameSource> open_simulator(std::string_view uri_after_scheme) {
    const SimulatorConfig config = parse_simulator_uri(uri_after_scheme);
    if (is_table(config.scene)) return std::make_unique<SimulatorSource>(config);
    return std::make_unique<MeshSource>(config);
}

}  // namespace touchstone
