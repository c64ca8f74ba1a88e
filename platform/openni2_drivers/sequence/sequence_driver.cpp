#include "platform/openni2_drivers/common/source_driver.hpp"
#include "platform/openni2_drivers/sequence/sequence_source.hpp"

namespace touchstone {

/// "seq:DIR", see sequence_folder.hpp.
class SequenceDriver : public SourceDriver {
  public:
    explicit SequenceDriver(OniDriverServices* services)
        : SourceDriver(services, {"seq:", "Touchstone sequence", open_sequence}) {}
};

}  // namespace touchstone

ONI_EXPORT_DRIVER(touchstone::SequenceDriver)
