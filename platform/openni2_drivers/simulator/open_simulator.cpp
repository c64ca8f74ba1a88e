#include <utility>

#include "platform/openni2_drivers/simulator/faulty_source.hpp"
#include "platform/openni2_drivers/simulator/mesh_source.hpp"
#include "platform/openni2_drivers/simulator/simulator_source.hpp"

namespace touchstone {

namespace {

std::unique_ptr<FrameSource> open_scene(const SimulatorConfig& config) {
    if (is_table(config.scene)) return std::make_unique<SimulatorSource>(config);
    return std::make_unique<MeshSource>(config);
}

}  // namespace

std::unique_ptr<FrameSource> open_simulator(std::string_view uri_after_scheme, std::uint64_t opening) {
    const SimulatorConfig config = parse_simulator_uri(uri_after_scheme);
    auto source = open_scene(config);
    if (!config.faults.any()) return source;
    return std::make_unique<FaultySource>(std::move(source), config.faults,
                                          sim::Random(config.seed, opening));
}

}  // namespace touchstone
