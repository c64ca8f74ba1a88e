#include "app/touch_sinks.hpp"

#include "platform/output/event_log.hpp"
#include "platform/output/tuio_sink.hpp"
#include "platform/output/udp_channel.hpp"
#include "platform/output/uinput_sink.hpp"
#include "platform/output/web_socket_channel.hpp"

namespace touchstone {

namespace {

using Sinks = std::vector<std::unique_ptr<TouchSink>>;

void add_tuio(Sinks& sinks, const TuioConfig& config) {
    sinks.push_back(
        std::make_unique<TuioSink>(std::make_unique<UdpChannel>(config.host, config.port), config.source));
    if (config.hover_port == 0) return;
    sinks.push_back(std::make_unique<TuioSink>(std::make_unique<UdpChannel>(config.host, config.hover_port),
                                               config.source, config.hover_height_mm));
}

}  // namespace

Sinks make_touch_sinks(const RunOptions& options) {
    const Config& config = options.config;
    Sinks sinks;
    if (options.events_file) sinks.push_back(std::make_unique<EventLog>(*options.events_file));
    if (config.tuio.enabled) add_tuio(sinks, config.tuio);
    if (config.web_socket_enabled) {
        sinks.push_back(std::make_unique<TuioSink>(std::make_unique<WebSocketChannel>(config.web_socket),
                                                   config.tuio.source));
    }
    if (config.touch_screen_enabled) sinks.push_back(std::make_unique<UinputSink>(config.touch_screen));
    return sinks;
}

}  // namespace touchstone
