#include "pipeline/still_components.hpp"

#include <algorithm>
#include <cstdlib>

namespace touchstone {

namespace {

constexpr std::uint64_t lost_after_us = 200'000;  // a still thing may be missed for some frames
constexpr std::uint64_t young_us = 300'000;       // younger ones may be parts of what moves
constexpr int rim_px = 4;                         // by which the rim of a still thing may flicker

PixelRegion region(const PixelBox& box) {
    return {box.min_x_px, box.min_y_px, box.max_x_px + 1, box.max_y_px + 1};
}

bool is_member(const DepthPatch& mean, int frames, std::size_t i) {
    return mean.samples[i] > 0 && 2 * mean.samples[i] >= std::min(frames, 255);
}

/// By a finger of another component: one that seems to be its own is a corner of it. A hand that is connected
/// to it makes it reach the picture's border, or move.
bool touched(const ForegroundComponent& component, const ObjectFrame& frame) {
    constexpr int reach_px = 6;
    return std::ranges::any_of(frame.touches_px, [&](const Eigen::Vector2f& tip) {
        const int u = static_cast<int>(tip.x()), v = static_cast<int>(tip.y());
        bool own = false, others = false;
        for (int y = std::max(0, v - reach_px); y <= std::min(v + reach_px, frame.shape.height_px - 1); ++y) {
            for (int x = std::max(0, u - reach_px); x <= std::min(u + reach_px, frame.shape.width_px - 1);
                 ++x) {
                const int label = frame.labels[map_index(frame.shape, x, y)];
                own |= label == component.label;
                others |= label >= 0 && label != component.label;
            }
        }
        return own && others;
    });
}

float overlap_share(const PixelRegion& a, const PixelRegion& b) {
    const int width = std::min(a.x1, b.x1) - std::max(a.x0, b.x0);
    const int height = std::min(a.y1, b.y1) - std::max(a.y0, b.y0);
    if (width <= 0 || height <= 0) return 0.0f;
    const int both = width * height;
    const int either = a.width_px() * a.height_px() + b.width_px() * b.height_px() - both;
    return static_cast<float>(both) / static_cast<float>(either);
}

}  // namespace

std::vector<DepthPatch> StillComponents::update(const ObjectFrame& frame) {
    std::vector<bool> moves(frame.components.size(), true);
    for (Track& track : tracks_) track.seen = false;
    for (const ForegroundComponent& component : frame.components) {
        if (!may_settle(component, frame)) continue;
        Track* track = find(region(component.box));
        if (track == nullptr) {
            tracks_.push_back(start(component, frame));
        } else if (!add(*track, component, frame)) {
            *track = start(component, frame);
        } else {
            moves[static_cast<std::size_t>(component.label)] =
                frame.timestamp_us - track->since_us < young_us;
        }
    }
    std::vector<DepthPatch> settled;
    std::erase_if(tracks_, [&](const Track& track) {
        const bool done = has_settled(track, frame, moves);
        if (done) settled.push_back(track.mean);
        return done || frame.timestamp_us > track.seen_us + lost_after_us;
    });
    for (DepthPatch& patch : settled) {  // the rim that was there less than half of the time is left out
        const auto most = static_cast<int>(*std::ranges::max_element(patch.samples));
        for (std::size_t i = 0; i < patch.depth_m.size(); ++i)
            if (!is_member(patch, most, i)) patch.depth_m[i] = 0.0f;
    }
    return settled;
}

bool StillComponents::may_settle(const ForegroundComponent& component, const ObjectFrame& frame) const {
    const PixelRegion box = region(component.box);
    const int margin = config_.border_px;
    if (box.x0 < margin || box.y0 < margin || box.x1 > intrinsics_.width_px - margin ||
        box.y1 > intrinsics_.height_px - margin)
        return false;
    const int side_px = std::max(box.width_px(), box.height_px());
    if (static_cast<float>(side_px) * component.mean_depth_m / intrinsics_.fx_px > config_.max_side_m)
        return false;
    return !touched(component, frame);
}

StillComponents::Track StillComponents::start(const ForegroundComponent& component,
                                              const ObjectFrame& frame) const {
    Track track;
    track.mean.box = grown(region(component.box), rim_px, intrinsics_.width_px, intrinsics_.height_px);
    const auto pixels = static_cast<std::size_t>(track.mean.box.width_px() * track.mean.box.height_px());
    track.mean.depth_m.assign(pixels, 0.0f);
    track.mean.samples.assign(pixels, 0);
    track.since_us = frame.timestamp_us;
    add(track, component, frame);
    return track;
}

StillComponents::Track* StillComponents::find(const PixelRegion& box) {
    Track* best = nullptr;
    float best_share = 0.5f;
    for (Track& track : tracks_) {
        const float share =
            overlap_share(grown(track.mean.box, -rim_px, intrinsics_.width_px, intrinsics_.height_px), box);
        if (track.seen || share < best_share) continue;
        best = &track;
        best_share = share;
    }
    return best;
}

/// False where the component has moved since the track began.
bool StillComponents::add(Track& track, const ForegroundComponent& component,
                          const ObjectFrame& frame) const {
    DepthPatch& mean = track.mean;
    int changed = 0, all = 0;
    for (int y = mean.box.y0; y < mean.box.y1; ++y) {
        for (int x = mean.box.x0; x < mean.box.x1; ++x) {
            const std::size_t i = mean.index(x, y), at = map_index(frame.shape, x, y);
            const bool was = track.frames > 0 && is_member(mean, track.frames, i);
            const bool is = frame.labels[at] == component.label;
            if (!was && !is) continue;
            ++all;
            const float z = frame.live_m[at], off = z - mean.depth_m[i];
            const bool fits =
                is && (mean.samples[i] == 0 ||
                       std::abs(off) < depth_tolerance_m(config_.noise, config_.quantisation_per_m,
                                                         config_.still_sigmas, z));
            changed += was != is || !fits;
            if (!fits) continue;
            if (mean.samples[i] < 255) ++mean.samples[i];
            mean.depth_m[i] += (z - mean.depth_m[i]) / static_cast<float>(mean.samples[i]);
        }
    }
    const PixelRegion now = region(component.box);
    const PixelRegion beyond = hull(now, mean.box);
    const bool grew = beyond.width_px() > mean.box.width_px() || beyond.height_px() > mean.box.height_px();
    // The rim of a still thing flickers by a pixel; a quarter of it may at a time.
    const int allowed = all / 20 + (mean.box.width_px() + mean.box.height_px()) / 2;
    const bool first = track.frames == 0;
    ++track.frames;
    track.seen = true;
    track.seen_us = frame.timestamp_us;
    return first || (!grew && changed <= allowed);
}

bool StillComponents::has_settled(const Track& track, const ObjectFrame& frame,
                                  const std::vector<bool>& moves) const {
    const auto needed_us = static_cast<std::uint64_t>(1e6f * config_.settle_s);
    if (!track.seen || frame.timestamp_us < track.since_us + needed_us) return false;
    const PixelRegion around =
        grown(track.mean.box, config_.near_px, intrinsics_.width_px, intrinsics_.height_px);
    for (int y = around.y0; y < around.y1; ++y) {
        for (int x = around.x0; x < around.x1; ++x) {
            const int label = frame.labels[map_index(frame.shape, x, y)];
            if (label >= 0 && moves[static_cast<std::size_t>(label)]) return false;
        }
    }
    return true;
}

}  // namespace touchstone
