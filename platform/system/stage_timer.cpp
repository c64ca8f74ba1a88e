#include "platform/system/stage_timer.hpp"

#include <algorithm>

#include "platform/system/percentile.hpp"

namespace touchstone {

StageTimes::StageTimes(std::size_t window_frames) : window_frames_(std::max<std::size_t>(1, window_frames)) {}

void StageTimes::add(std::string_view stage, double ms) {
    auto found =
        std::find_if(stages_.begin(), stages_.end(), [&](const Stage& s) { return s.name == stage; });
    if (found == stages_.end()) {
        stages_.push_back(Stage{.name = std::string(stage), .ring_ms = {}});
        found = stages_.end() - 1;
    }
    found->frame_ms += ms;
    found->ran = true;
}

void StageTimes::end_frame() {
    for (Stage& stage : stages_) {
        if (!stage.ran) continue;
        if (stage.ring_ms.size() < window_frames_) {
            stage.ring_ms.push_back(stage.frame_ms);
        } else {
            stage.ring_ms[stage.next] = stage.frame_ms;
        }
        stage.next = (stage.next + 1) % window_frames_;
        stage.frame_ms = 0.0;
        stage.ran = false;
    }
}

void StageTimes::clear() { stages_.clear(); }

std::vector<StageSummary> StageTimes::summary() const {
    std::vector<StageSummary> all;
    for (const Stage& stage : stages_) all.push_back(summarize(stage));
    return all;
}

StageSummary StageTimes::summary(std::string_view stage) const {
    for (const Stage& s : stages_) {
        if (s.name == stage) return summarize(s);
    }
    return StageSummary{.stage = std::string(stage)};
}

StageSummary StageTimes::summarize(const Stage& stage) const {
    return {stage.name, percentile(stage.ring_ms, 50.0), percentile(stage.ring_ms, 99.0),
            stage.ring_ms.size()};
}

}  // namespace touchstone
