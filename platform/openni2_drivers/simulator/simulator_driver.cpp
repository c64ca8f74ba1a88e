#include <memory>
#include <string_view>

#include "platform/openni2_drivers/common/source_driver.hpp"

namespace touchstone {

std::unique_ptr<FrameSource> open_simulator(std::string_view after_scheme);

/// "sim:SCENE?key=value&...".
class SimulatorDriver : public SourceDriver {
  public:
    explicit SimulatorDriver(OniDriverServices* services)
        : SourceDriver(services, {"sim:", "Touchstone simulator", open_simulator}) {}
};

}  // namespace touchstone

ONI_EXPORT_DRIVER(touchstone::SimulatorDriver)
