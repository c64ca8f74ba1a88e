#include "platform/output/tuio_sink.hpp"

#include <array>
#include <chrono>
#include <limits>
#include <unistd.h>
#include <utility>

namespace touchstone {
namespace {

std::string host_name() {
    std::array<char, 65> host{};
    ::gethostname(host.data(), host.size() - 1);
    return host.data();
}

std::string source_name(const std::string& wanted) {
    return wanted.empty() ? "touchstone@" + host_name() : wanted;
}

/// Far enough from those of other sources that a run of years does not get there.
TuioStart start_of(int number) {
    constexpr std::int32_t apart = 1 << 26;
    TuioStart start = tuio_start(std::chrono::system_clock::now());
    for (int i = 0; i < number; ++i)
        start.session = start.session > std::numeric_limits<std::int32_t>::max() - apart
                            ? start.session - std::numeric_limits<std::int32_t>::max() + apart
                            : start.session + apart;
    return start;
}

}  // namespace

std::string area_source(const std::string& table_source, const std::string& area) {
    return table_source.empty() ? "touchstone-" + area + "@" + host_name() : table_source + "-" + area;
}

TuioSink::TuioSink(std::unique_ptr<OscChannel> channel, const std::string& source,
                   std::optional<double> unit_height_mm, int number)
    : channel_(std::move(channel)),
      source_(source_name(source)),
      profile_(unit_height_mm ? TuioProfile::cursors_25d : TuioProfile::cursors_2d),
      session_(start_of(number), unit_height_mm) {
    send(session_.start(TuioSession::Clock::now()));
}

TuioSink::~TuioSink() { send(session_.release_all(TuioSession::Clock::now())); }

void TuioSink::publish(const TouchReport& report) { send(session_.frame(report, TuioSession::Clock::now())); }

void TuioSink::release_all() { send(session_.release_all(TuioSession::Clock::now())); }

void TuioSink::idle() { send(session_.refresh(TuioSession::Clock::now())); }

void TuioSink::send(const TuioSession::Bundles& bundles) {
    for (const TuioBundle& state : bundles) {
        for (const OscBundle& bundle : osc_bundles(state, profile_, source_, channel_->largest_bundle()))
            channel_->send(bundle);
    }
}

}  // namespace touchstone
