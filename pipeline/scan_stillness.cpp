#include "pipeline/scan_stillness.hpp"

#include "pipeline/kernel_program.hpp"

namespace touchstone {

namespace {

/// Pixels for which it holds there and at their four neighbours.
template <class Holds>
int count_inner(const MapShape& shape, Holds holds) {
    int count = 0;
    for (int y = 1; y + 1 < shape.height_px; ++y) {
        for (int x = 1; x + 1 < shape.width_px; ++x) {
            const std::size_t at = map_index(shape, x, y), pitch = static_cast<std::size_t>(shape.pitch_px);
            count += holds(at) && holds(at - 1) && holds(at + 1) && holds(at - pitch) && holds(at + pitch);
        }
    }
    return count;
}

}  // namespace

ScanStillness::ScanStillness(const Device& device, const ScanStillnessConfig& config,
                             const Intrinsics& intrinsics)
    : config_(config),
      shape_(make_map_shape(intrinsics)),
      program_(load_kernel_program(device, "scan_stillness.cl")),
      judge_stillness_(program_.kernel("judge_stillness")),
      mean_m_(device, map_pixels(shape_)),
      other_m_(device, map_pixels(shape_)),
      frames_(device, map_pixels(shape_)),
      other_frames_(device, map_pixels(shape_)),
      moving_(device, map_pixels(shape_)),
      replaced_(device, map_pixels(shape_)) {
    restart();
}

void ScanStillness::restart() {
    mean_m_.fill(0.0f);
    other_m_.fill(0.0f);
    for (Buffer<std::uint8_t>* map : {&frames_, &other_frames_, &moving_, &replaced_}) map->fill(0);
    moving_share_ = unknown_share_ = 0.0f;
}

void ScanStillness::judge(LiveMaps& live) {
    judge_stillness_.launch(eight_pixels_each(shape_), live.depth_m, live.filtered_m, mean_m_, frames_,
                            other_m_, other_frames_, moving_, replaced_, shape_, config_.noise,
                            config_.quantisation_per_m, config_.sigmas, config_.least_frames);
    const auto moving = moving_.map_read();
    const auto frames = frames_.map_read();
    const float pixels = static_cast<float>(shape_.width_px * shape_.height_px);
    const int moved = count_inner(shape_, [&](std::size_t at) { return moving[at] != 0; });
    const int unknown = count_inner(
        shape_, [&](std::size_t at) { return frames[at] > 0 && frames[at] < config_.least_frames; });
    moving_share_ = static_cast<float>(moved) / pixels;
    unknown_share_ = static_cast<float>(unknown) / pixels;
}

ScanStillness::StillView ScanStillness::still_view() const {
    StillView view{mean_m_.read(), frames_.read(), false};
    const auto replaced = replaced_.map_read();
    const auto is_unknown = [&](std::size_t at) {
        return view.frames[at] > 0 && view.frames[at] < config_.least_frames;
    };
    const int wrong =
        count_inner(shape_, [&](std::size_t at) { return replaced[at] != 0 || is_unknown(at); });
    view.replaces_scan = wrong >= config_.min_replaced_px;
    for (std::size_t at = 0; at < view.depth_m.size(); ++at) {
        if (!is_unknown(at)) continue;
        view.depth_m[at] = 0.0f;
        view.frames[at] = 0;
    }
    return view;
}

}  // namespace touchstone
