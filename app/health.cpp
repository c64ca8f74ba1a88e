#include "app/health.hpp"

#include <cmath>
#include <fmt/format.h>
#include <numeric>

#include "app/frame_health.hpp"
#include "platform/system/log.hpp"
#include "platform/system/process_memory.hpp"

namespace touchstone {

namespace {

constexpr std::chrono::seconds between_readings{1}, between_lines{60};
/// Longer gaps are a clock's or a camera's, not frames that were lost.
constexpr double longest_gap_s = 2.0;

std::uint64_t total(const std::map<std::string, std::uint64_t>& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const auto& one) { return sum + one.second; });
}

}  // namespace

std::string health_line(const HealthFigures& before, const HealthFigures& now, double seconds) {
    const std::uint64_t frames = now.frames - before.frames;
    std::string line = fmt::format(
        "health: {}, {} frames at {:.1f} Hz, {} missed, {} touches, {} faults and {} restarts of the camera",
        now.state, frames, static_cast<double>(frames) / seconds, now.missed_frames - before.missed_frames,
        now.touches - before.touches, total(now.faults) - total(before.faults),
        total(now.restarts) - total(before.restarts));
    if (now.lost_packets)
        line += fmt::format(", {} packets lost on USB", *now.lost_packets - before.lost_packets.value_or(0));
    if (const std::uint64_t unsaved = total(now.unsaved); unsaved > 0)
        line += fmt::format(", {} times something could not be written", unsaved);
    for (const StageSummary& stage : now.stages) {
        if (stage.stage == "frame")
            line += fmt::format(", frame {:.1f} ms (99 % {:.1f})", stage.median_ms, stage.p99_ms);
    }
    line += fmt::format(", {:.0f} MB", now.resident_mb);
    for (const Temperature& temperature : now.temperatures)
        line += fmt::format(", {} {:.0f} C", temperature.zone, temperature.celsius);
    return line;
}

Health::Health(const HealthConfig& config, Time now) : read_at_(now), line_at_(now + between_lines) {
    // A counter that is not there until something happens cannot be watched.
    for (const CameraFault& fault : {silent_camera, frozen_camera, blind_camera, torn_camera})
        figures_.faults[std::string(fault.word)] = 0;
    for (const char* kind : {"lost", "clock"}) figures_.faults[kind] = 0;
    for (const char* what : {"stream", "camera", "usb"}) figures_.restarts[what] = 0;
    for (const char* what : {"scan", "touch bias", "painting", "projector's calibration"})
        figures_.unsaved[what] = 0;
    if (config.port == 0) return;
    page_.emplace(config.port);
    log_info("health: http://127.0.0.1:{}/metrics", page_->port());
}

void Health::frame(std::uint64_t time_us, double camera_rate_hz, int touches_down) {
    ++figures_.frames;
    figures_.touches += static_cast<std::uint64_t>(touches_down);
    if (last_frame_us_ && time_us > *last_frame_us_) {
        const double gap_s = 1e-6 * static_cast<double>(time_us - *last_frame_us_);
        const auto steps = static_cast<std::uint64_t>(std::lround(gap_s * camera_rate_hz));
        if (gap_s < longest_gap_s && steps > 1) figures_.missed_frames += steps - 1;
    }
    last_frame_us_ = time_us;
}

void Health::tick(Time now, const std::string& state, double frame_rate_hz, const StageTimes* stages) {
    if (now < (page_ ? read_at_ : line_at_)) return;
    read_at_ = now + between_readings;
    figures_.state = state;
    figures_.frame_rate_hz = frame_rate_hz;
    figures_.resident_mb = resident_mb();
    figures_.temperatures = read_temperatures();
    if (stages != nullptr) figures_.stages = stages->summary();
    if (page_) page_->show(figures_);
    if (now < line_at_) return;
    const std::chrono::duration<double> since = now - line_at_ + between_lines;
    log_info("{}", health_line(at_last_line_, figures_, since.count()));
    line_at_ = now + between_lines;
    at_last_line_ = figures_;
}

}  // namespace touchstone
