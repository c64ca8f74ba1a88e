#include "app/touch_sinks.hpp"

#include "platform/output/event_log.hpp"
#include "platform/output/tuio_sink.hpp"
#include "platform/output/uinput_sink.hpp"

namespace touchstone {

std::vector<std::unique_ptr<TouchSink>> make_touch_sinks(const RunOptions& options) {
    const Config& config = options.config;
    std::vector<std::unique_ptr<TouchSink>> sinks;
    if (options.events_file) sinks.push_back(std::make_unique<EventLog>(*options.events_file));
    if (config.tuio_enabled) sinks.push_back(std::make_unique<TuioSink>(config.tuio));
    if (config.touch_screen_enabled) sinks.push_back(std::make_unique<UinputSink>(config.touch_screen));
    return sinks;
}

}  // namespace touchstone
