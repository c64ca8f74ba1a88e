#include "platform/output/tuio_sink.hpp"

#include <array>
#include <chrono>
#include <unistd.h>
#include <utility>

namespace touchstone {
namespace {

std::string source_name(const std::string& wanted) {
    if (!wanted.empty()) return wanted;
    std::array<char, 65> host{};
    ::gethostname(host.data(), host.size() - 1);
    return "touchstone@" + std::string(host.data());
}

}  // namespace

TuioSink::TuioSink(std::unique_ptr<OscChannel> channel, const std::string& source,
                   std::optional<double> unit_height_mm)
    : channel_(std::move(channel)),
      source_(source_name(source)),
      profile_(unit_height_mm ? TuioProfile::cursors_25d : TuioProfile::cursors_2d),
      session_(tuio_start(std::chrono::system_clock::now()), unit_height_mm) {
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
