#include "app/touch_outputs.hpp"

#include <fmt/format.h>

#include "platform/output/area_sink.hpp"
#include "platform/output/event_log.hpp"
#include "platform/output/tuio_sink.hpp"
#include "platform/output/udp_channel.hpp"
#include "platform/output/uinput_sink.hpp"
#include "platform/output/web_socket_channel.hpp"
#include "platform/system/log.hpp"

namespace touchstone {

namespace {

/// One channel for several sources.
class SharedChannel : public OscChannel {
  public:
    explicit SharedChannel(std::shared_ptr<OscChannel> channel) : channel_(std::move(channel)) {}
    std::size_t largest_bundle() const override { return channel_->largest_bundle(); }
    void send(const OscBundle& bundle) override { channel_->send(bundle); }

  private:
    std::shared_ptr<OscChannel> channel_;
};

}  // namespace

TouchOutputs::TouchOutputs(const RunOptions& options, std::span<const NamedArea> areas)
    : source_(options.config.tuio.source) {
    const Config& config = options.config;
    const TuioConfig& tuio = config.tuio;
    std::vector<std::string> told;
    if (options.events_file) {
        of_table_.push_back(std::make_unique<EventLog>(*options.events_file));
        told.push_back(*options.events_file == "-" ? "standard output" : *options.events_file);
    }
    if (config.touch_screen_enabled) {
        of_table_.push_back(std::make_unique<UinputSink>(config.touch_screen));
        told.emplace_back("a touch screen of this machine");
    }
    if (tuio.enabled) {
        ports_.push_back({std::make_shared<UdpChannel>(tuio.host, tuio.port), {}});
        told.push_back(fmt::format("TUIO at {}:{}", tuio.host, tuio.port));
    }
    if (tuio.enabled && tuio.hover_port != 0) {
        ports_.push_back({std::make_shared<UdpChannel>(tuio.host, tuio.hover_port), tuio.hover_height_mm});
        told.push_back(fmt::format("TUIO with hovers at {}:{}", tuio.host, tuio.hover_port));
    }
    if (config.web_socket_enabled) {
        ports_.push_back({std::make_shared<WebSocketChannel>(config.web_socket), {}});
        told.push_back(fmt::format("ws://{}:{}", config.web_socket.host, config.web_socket.port));
    }
    log_info("touches go to {}",
             told.empty() ? "the display only" : fmt::format("{}", fmt::join(told, ", ")));
    set_areas(areas);
}

void TouchOutputs::set_areas(std::span<const NamedArea> areas) {
    of_areas_.clear();
    for (const Port& port : ports_) {
        const auto tuio = [&](const std::string& source, int number) {
            return std::make_unique<TuioSink>(std::make_unique<SharedChannel>(port.channel), source,
                                              port.unit_height_mm, number);
        };
        if (areas.empty()) of_areas_.push_back(tuio(source_, 0));
        for (std::size_t i = 0; i < areas.size(); ++i) {
            const NamedArea& area = areas[i];
            const std::string source = area.source.empty() ? area_source(source_, area.name) : area.source;
            of_areas_.push_back(std::make_unique<AreaSink>(tuio(source, static_cast<int>(i)), area.name));
        }
    }
}

void TouchOutputs::publish(const TouchReport& report) {
    for (const auto* sinks : {&of_table_, &of_areas_})
        for (const auto& sink : *sinks) sink->publish(report);
}

void TouchOutputs::release_all() {
    for (const auto* sinks : {&of_table_, &of_areas_})
        for (const auto& sink : *sinks) sink->release_all();
}

void TouchOutputs::idle() {
    for (const auto* sinks : {&of_table_, &of_areas_})
        for (const auto& sink : *sinks) sink->idle();
}

}  // namespace touchstone
