#include "platform/output/area_sink.hpp"

namespace touchstone {

void AreaSink::publish(const TouchReport& report) {
    TouchReport ours = report;
    for (std::vector<ReportedFinger>* fingers : {&ours.touches, &ours.hovers}) {
        std::erase_if(*fingers, [&](const ReportedFinger& finger) { return finger.area != area_; });
        for (ReportedFinger& finger : *fingers) finger.surface = finger.area_surface;
    }
    sink_->publish(ours);
}

}  // namespace touchstone
