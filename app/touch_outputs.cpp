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

/// For people: every receiver that the configuration names.
std::string destinations(const RunOptions& options) {
    const Config& config = options.config;
    std::vector<std::string> all;
    if (config.tuio.enabled) all.push_back(fmt::format("TUIO at {}:{}", config.tuio.host, config.tuio.port));
    if (config.tuio.enabled && config.tuio.hover_port != 0)
        all.push_back(fmt::format("TUIO with hovers at {}:{}", config.tuio.host, config.tuio.hover_port));
    if (config.web_socket_enabled)
        all.push_back(fmt::format("ws://{}:{}", config.web_socket.host, config.web_socket.port));
    if (config.touch_screen_enabled) all.emplace_back("a touch screen of this machine");
    if (options.events_file)
        all.push_back(*options.events_file == "-" ? "standard output" : *options.events_file);
    return all.empty() ? "the display only" : fmt::format("{}", fmt::join(all, ", "));
}

}  // namespace

TouchOutputs::TouchOutputs(const RunOptions& options, std::span<const NamedArea> areas)
    : source_(options.config.tuio.source) {
    const Config& config = options.config;
    const TuioConfig& tuio = config.tuio;
    if (options.events_file) of_table_.push_back(std::make_unique<EventLog>(*options.events_file));
    if (config.touch_screen_enabled) of_table_.push_back(std::make_unique<UinputSink>(config.touch_screen));
    if (tuio.enabled) ports_.push_back({std::make_shared<UdpChannel>(tuio.host, tuio.port), {}});
    if (tuio.enabled && tuio.hover_port != 0)
        ports_.push_back({std::make_shared<UdpChannel>(tuio.host, tuio.hover_port), tuio.hover_height_mm});
    if (config.web_socket_enabled)
        ports_.push_back({std::make_shared<WebSocketChannel>(config.web_socket), {}});
    log_info("touches go to {}", destinations(options));
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
