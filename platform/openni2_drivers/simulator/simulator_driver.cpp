#include "platform/openni2_drivers/common/source_driver.hpp"
#include "platform/openni2_drivers/simulator/simulator_source.hpp"

namespace touchstone {

/// "sim:SCENE?key=value&...".
class SimulatorDriver : public SourceDriver {
  public:
    explicit SimulatorDriver(OniDriverServices* services)
        : SourceDriver(services, {"sim:", "Touchstone simulator",
                                  [opening = std::uint64_t{0}](std::string_view uri) mutable {
                                      return open_simulator(uri, opening++);
                                  }}) {}
};

}  // namespace touchstone

ONI_EXPORT_DRIVER(touchstone::SimulatorDriver)
