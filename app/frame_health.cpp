#include "app/frame_health.hpp"

#include <algorithm>
#include <cstdlib>

namespace touchstone {
namespace {

constexpr int half_a_second_frames = 15;
constexpr int least_torn_rows = 8;
constexpr std::int64_t jump_us = 2'000'000;

bool is_blind(const std::vector<std::uint16_t>& depth_mm) {
    return std::all_of(depth_mm.begin(), depth_mm.end(), [](std::uint16_t mm) { return mm == 0; });
}

}  // namespace

/// No row of a sensor's noise is measured twice: rows that were, in a picture that is new, are left from
/// before.
bool FrameJudge::is_torn(const DepthFrame& frame) const {
    if (last_mm_.size() != frame.depth_mm.size()) return false;
    int left_over = 0;
    for (int y = 0; y < frame.height_px; ++y) {
        const auto first = static_cast<std::ptrdiff_t>(y) * frame.width_px, end = first + frame.width_px;
        if (!std::equal(frame.depth_mm.begin() + first, frame.depth_mm.begin() + end,
                        last_mm_.begin() + first))
            continue;
        const auto missing = std::count(frame.depth_mm.begin() + first, frame.depth_mm.begin() + end, 0);
        left_over += frame.width_px - missing >= frame.width_px / 4;
    }
    return left_over >= least_torn_rows;
}

FrameHealth FrameJudge::judge(const DepthFrame& frame) {
    blind_ = is_blind(frame.depth_mm) ? blind_ + 1 : 0;
    same_ = frame.depth_mm == last_mm_ ? same_ + 1 : 0;
    if (same_ == 0 && is_torn(frame)) {
        last_mm_ = frame.depth_mm;
        return FrameHealth::torn;
    }
    if (same_ == 0) last_mm_ = frame.depth_mm;
    if (blind_ >= half_a_second_frames) return FrameHealth::blind;
    return same_ >= half_a_second_frames ? FrameHealth::frozen : FrameHealth::good;
}

std::uint64_t SteadyTime::steady_us(std::uint64_t camera_us, std::uint64_t host_us) {
    const auto host = static_cast<std::int64_t>(host_us), camera = static_cast<std::int64_t>(camera_us);
    if (last_) {
        const std::int64_t expected = last_->time_us + host - last_->host_us;
        if (std::abs(camera + offset_us_ - expected) > jump_us) {
            offset_us_ = expected - camera;
            ++jumps_;
        }
    }
    last_ = Reading{camera + offset_us_, host};
    return static_cast<std::uint64_t>(last_->time_us);
}

}  // namespace touchstone
