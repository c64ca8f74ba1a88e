#include "platform/openni2_drivers/simulator/faulty_source.hpp"

#include <algorithm>

namespace touchstone {
namespace {

constexpr std::uint64_t hour_us = 3'600'000'000;

/// The upper half of the new picture over the lower half of the last.
void tear(std::vector<std::uint16_t>& depth_mm, const std::vector<std::uint16_t>& last_mm) {
    if (last_mm.size() != depth_mm.size()) return;
    const auto half = static_cast<std::ptrdiff_t>(depth_mm.size() / 2);
    std::copy(last_mm.begin() + half, last_mm.end(), depth_mm.begin() + half);
}

}  // namespace

FaultySource::FaultySource(std::unique_ptr<FrameSource> source, const SimulatorFaults& faults,
                           const sim::Random& random)
    : source_(std::move(source)), faults_(faults), random_(random) {
    next_drawn_s_ = faults_.every_s * static_cast<double>(random_.uniform(0.5f, 1.5f));
}

void FaultySource::draw_fault() {
    if (faults_.every_s <= 0 || time_s_ < next_drawn_s_) return;
    double* const starts_s[] = {&faults_.unplug_s, &faults_.stall_s, &faults_.freeze_s, &faults_.tear_s,
                                &faults_.clock_jump_s};
    *starts_s[random_.below(5)] = time_s_;
    next_drawn_s_ = time_s_ + faults_.every_s * static_cast<double>(random_.uniform(0.5f, 1.5f));
}

bool FaultySource::lasts(double start_s, double time_s) const {
    return start_s >= 0 && time_s >= start_s && (faults_.fault_s == 0 || time_s < start_s + faults_.fault_s);
}

void FaultySource::restarted() {
    for (double* start_s : {&faults_.stall_s, &faults_.freeze_s})
        if (lasts(*start_s, time_s_)) *start_s = -1.0;
}

bool FaultySource::next(SourceFrame& frame) {
    if (!source_->next(made_)) return false;
    time_s_ = static_cast<double>(made_.timestamp_us) / 1e6;
    frame = made_;
    draw_fault();
    if (faults_.unplug_s >= 0 && time_s_ >= faults_.unplug_s) {
        frame.back_after_s = faults_.fault_s;
        return true;
    }
    frame.withheld = lasts(faults_.stall_s, time_s_);
    if (faults_.clock_jump_s >= 0 && time_s_ >= faults_.clock_jump_s) {
        clock_ahead_us_ += hour_us;
        faults_.clock_jump_s = -1.0;
    }
    frame.timestamp_us += clock_ahead_us_;
    if (lasts(faults_.freeze_s, time_s_)) {
        frame.depth_mm = last_mm_;
        frame.color_rgb = last_rgb_;
        return true;
    }
    if (faults_.tear_s >= 0 && time_s_ >= faults_.tear_s) {
        tear(frame.depth_mm, last_mm_);
        faults_.tear_s = faults_.tear_every_s > 0 ? faults_.tear_s + faults_.tear_every_s : -1.0;
    }
    last_mm_ = made_.depth_mm;
    last_rgb_ = made_.color_rgb;
    return true;
}

}  // namespace touchstone
