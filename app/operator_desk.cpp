#include "app/operator_desk.hpp"

#include <algorithm>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <utility>

namespace touchstone {

namespace {

constexpr int thumbnail_width_px = 160;
constexpr std::size_t most_faults = 5;
constexpr std::chrono::seconds recording_length{10};

/// Every n-th pixel of a map, so that it is about as wide as a thumbnail.
template <class Gray>
Thumbnail thinned(PixelSize size, Gray gray) {
    const int step = std::max(1, size.width_px / thumbnail_width_px);
    Thumbnail small{{size.width_px / step, size.height_px / step}, {}};
    for (int y = 0; y < small.size.height_px; ++y)
        for (int x = 0; x < small.size.width_px; ++x)
            small.gray.push_back(gray(static_cast<std::size_t>(y * step * size.width_px + x * step)));
    return small;
}

int newly_asked(int& known, int wished) {
    const int before = std::exchange(known, wished);
    return std::max(0, wished - before);
}

}  // namespace

Thumbnail depth_thumbnail(const DepthFrame& frame) {
    std::uint16_t nearest = 0xffff, farthest = 0;
    for (const std::uint16_t depth : frame.depth_mm) {
        if (depth == 0) continue;
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
    }
    const float range = std::max(1.0f, static_cast<float>(farthest) - static_cast<float>(nearest));
    return thinned({frame.width_px, frame.height_px}, [&](std::size_t pixel) {
        const std::uint16_t depth = frame.depth_mm[pixel];
        if (depth == 0) return std::uint8_t{0};
        const float near_share = static_cast<float>(farthest - depth) / range;
        return static_cast<std::uint8_t>(60.0f + 195.0f * near_share);
    });
}

Thumbnail mask_thumbnail(std::span<const std::uint8_t> map, PixelSize size) {
    return thinned(size, [&](std::size_t pixel) { return std::uint8_t(map[pixel] != 0 ? 255 : 0); });
}

OperatorWish OperatorDesk::take(const OperatorWish& wish) {
    wish_.open = wish.open;
    return {wish.open,
            newly_asked(wish_.rescans, wish.rescans),
            newly_asked(wish_.recalibrations, wish.recalibrations),
            newly_asked(wish_.recordings, wish.recordings),
            newly_asked(wish_.projector_calibrations, wish.projector_calibrations),
            newly_asked(wish_.area_lists, wish.area_lists),
            wish.areas,
            wish.unsaved};
}

void OperatorDesk::note_fault(const std::string& word, const std::string& reason,
                              std::chrono::system_clock::time_point clock) {
    const std::time_t seconds = std::chrono::system_clock::to_time_t(clock);
    faults_.push_front(fmt::format("{:%H:%M:%S} {}: {}", fmt::localtime(seconds), word, reason));
    if (faults_.size() > most_faults) faults_.pop_back();
}

void OperatorDesk::see(const DepthFrame& frame, const InteractionPipeline& pipeline) {
    if (!is_open()) return;
    depth_ = depth_thumbnail(frame);
    mask_ = mask_thumbnail(pipeline.foreground_map(), {frame.width_px, frame.height_px});
}

void OperatorDesk::begin_recording(Time now, const std::string& dir) {
    if (records()) return;
    recorded_at_ = now + recording_length;
    recording_dir_ = dir;
}

bool OperatorDesk::ends_recording(Time now) {
    if (!records() || now < *recorded_at_) return false;
    recorded_at_.reset();
    has_recorded_ = true;
    return true;
}

OperatorView OperatorDesk::view(Time now) const {
    OperatorView view;
    view.area_lists = wish_.area_lists;
    view.faults.assign(faults_.begin(), faults_.end());
    view.depth = depth_;
    view.mask = mask_;
    if (records()) {
        const auto left = std::chrono::ceil<std::chrono::seconds>(*recorded_at_ - now);
        view.recording = fmt::format("Recording: {} s to go", std::max<long long>(0, left.count()));
    } else if (has_recorded_) {
        view.recording = "Recorded: the newest fault-...-operator in " + recording_dir_;
    }
    return view;
}

}  // namespace touchstone
