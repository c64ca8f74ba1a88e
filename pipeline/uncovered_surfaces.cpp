#include "pipeline/uncovered_surfaces.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

namespace touchstone {

namespace {

constexpr int tile_pixels_behind = TILE_PX * TILE_PX / 4;
constexpr int around_px = 8;  // what is averaged around it
constexpr int apart_px = 4;   // from what moves
constexpr float growth_sigmas = 2.0f;

using Step = std::pair<int, int>;
constexpr std::array<Step, 4> neighbours{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

/// Where something that was put down goes, SettledObjects knows what was behind it.
bool is_behind(const ObjectFrame& frame, std::size_t at) {
    return frame.rejection[at] == ASSOCIATION_BEHIND && (frame.settled.empty() || frame.settled[at] == 0);
}

/// The pixels behind the background that are connected with one; none where it was visited before.
std::vector<Step> connected_behind(const ObjectFrame& frame, const Step& from,
                                   std::vector<std::uint8_t>& visited) {
    const MapShape& shape = frame.shape;
    std::vector<Step> open{from}, pixels;
    while (!open.empty()) {
        const auto [x, y] = open.back();
        open.pop_back();
        if (x < 0 || y < 0 || x >= shape.width_px || y >= shape.height_px) continue;
        const std::size_t at = map_index(shape, x, y);
        if (visited[at] != 0 || !is_behind(frame, at)) continue;
        visited[at] = 1;
        pixels.emplace_back(x, y);
        for (const auto& [dx, dy] : neighbours) open.emplace_back(x + dx, y + dy);
    }
    return pixels;
}

}  // namespace

bool UncoveredSurfaces::wants(std::span<const std::uint8_t> rejection, const MapShape& shape) {
    seeds_.clear();
    std::vector<int> counts(static_cast<std::size_t>(tiles_per_row(shape)));
    for (int top = 0; top < shape.rows_px; top += TILE_PX) {
        std::ranges::fill(counts, 0);
        for (int y = top; y < top + TILE_PX; ++y) {
            const auto row =
                rejection.subspan(map_index(shape, 0, y), static_cast<std::size_t>(shape.pitch_px));
            for (std::size_t tile = 0; tile < counts.size(); ++tile) {
                int count = 0;
                for (std::size_t i = 0; i < TILE_PX; ++i)
                    count += row[tile * TILE_PX + i] == ASSOCIATION_BEHIND;
                counts[tile] += count;
            }
        }
        for (std::size_t tile = 0; tile < counts.size(); ++tile)
            if (counts[tile] >= tile_pixels_behind)
                seeds_.push_back(static_cast<int>(map_index(shape, static_cast<int>(tile) * TILE_PX, top)));
    }
    return !seeds_.empty() || !tracks_.empty();
}

std::vector<UncoveredSurface> UncoveredSurfaces::update(const ObjectFrame& frame) {
    for (Track& track : tracks_) track.seen = false;
    for (Track& region : regions(frame)) {
        const auto same = std::ranges::find_if(
            tracks_, [&](const Track& track) { return !track.seen && overlap(track.box, region.box); });
        if (same == tracks_.end()) {
            average(region, frame);
            tracks_.push_back(std::move(region));
        } else {
            follow(*same, std::move(region), frame);
        }
    }
    std::erase_if(tracks_, [](const Track& track) { return !track.seen; });
    std::vector<UncoveredSurface> lifted;
    std::erase_if(tracks_, [&](Track& track) {
        const bool done = track.frames >= config_.lifted_frames && !track.given_up;
        if (done) {
            grow(track.surface, frame);
            lifted.push_back(std::move(track.surface));
        }
        return done;
    });
    return lifted;
}

std::vector<UncoveredSurface> UncoveredSurfaces::pending() const {
    std::vector<UncoveredSurface> surfaces;
    for (const Track& track : tracks_)
        if (!track.given_up) surfaces.push_back(track.surface);
    return surfaces;
}

/// Connected pixels behind the background that reach one of the tiles with many of them.
std::vector<UncoveredSurfaces::Track> UncoveredSurfaces::regions(const ObjectFrame& frame) const {
    std::vector<Track> found;
    const int pitch = frame.shape.pitch_px;
    std::vector<std::uint8_t> visited(map_pixels(frame.shape), 0);
    for (const int seed : seeds_) {
        for (int i = 0; i < TILE_PX * TILE_PX; ++i) {
            const Step from{seed % pitch + i % TILE_PX, seed / pitch + i / TILE_PX};
            const std::vector<Step> pixels = connected_behind(frame, from, visited);
            if (pixels.size() < tile_pixels_behind) continue;
            Track region = make_region(pixels, frame);
            if (is_sized(region, frame)) found.push_back(std::move(region));
        }
    }
    return found;
}

UncoveredSurfaces::Track UncoveredSurfaces::make_region(std::span<const Step> pixels,
                                                        const ObjectFrame& frame) const {
    Track region;
    region.box = {pixels[0].first, pixels[0].second, pixels[0].first + 1, pixels[0].second + 1};
    for (const auto& [x, y] : pixels) region.box = hull(region.box, {x, y, x + 1, y + 1});
    region.pixels = static_cast<int>(pixels.size());
    region.first_us = frame.timestamp_us;
    region.seen = true;
    DepthPatch& mean = region.surface.mean;
    mean.box = grown(region.box, around_px, frame.shape.width_px, frame.shape.height_px);
    const auto size = static_cast<std::size_t>(mean.box.width_px() * mean.box.height_px());
    mean.depth_m.assign(size, 0.0f);
    mean.samples.assign(size, 0);
    region.surface.inside.assign(size, 0);
    for (const auto& [x, y] : pixels) region.surface.inside[mean.index(x, y)] = 1;
    return region;
}

/// Neither noise nor a door.
bool UncoveredSurfaces::is_sized(const Track& region, const ObjectFrame& frame) const {
    float nearest_m = 0.0f;  // of the thing that stood there
    for (int y = region.box.y0; y < region.box.y1; ++y) {
        for (int x = region.box.x0; x < region.box.x1; ++x) {
            if (!region.surface.is_inside(x, y)) continue;
            const float z = frame.predicted_m[map_index(frame.shape, x, y)];
            if (z > 0.0f && (nearest_m <= 0.0f || z < nearest_m)) nearest_m = z;
        }
    }
    const float pixel_m = nearest_m / intrinsics_.fx_px;
    const int side_px = std::max(region.box.width_px(), region.box.height_px());
    return static_cast<float>(region.pixels) * pixel_m * pixel_m >= config_.min_lifted_area_m2 &&
           static_cast<float>(side_px) * pixel_m <= config_.max_side_m;
}

void UncoveredSurfaces::follow(Track& track, Track&& region, const ObjectFrame& frame) const {
    const PixelRegion both = hull(track.box, region.box);
    int changed = 0;
    for (int y = both.y0; y < both.y1; ++y) {
        for (int x = both.x0; x < both.x1; ++x)
            changed += track.surface.is_inside(x, y) != region.surface.is_inside(x, y);
    }
    const int allowed = region.pixels / 20 + (both.width_px() + both.height_px()) / 2;
    const bool still = changed <= allowed && is_alone(region, frame);
    track.seen = true;
    const float age_s = 1e-6f * static_cast<float>(frame.timestamp_us - track.first_us);
    track.given_up = age_s > config_.give_up_s;
    if (still) {
        average(track, frame);
        return;
    }
    region.first_us = track.first_us;
    region.given_up = track.given_up;
    track = std::move(region);
}

/// One frame more of what is seen there and around it.
void UncoveredSurfaces::average(Track& track, const ObjectFrame& frame) const {
    DepthPatch& mean = track.surface.mean;
    for (int y = mean.box.y0; y < mean.box.y1; ++y) {
        for (int x = mean.box.x0; x < mean.box.x1; ++x) {
            const std::size_t i = mean.index(x, y), at = map_index(frame.shape, x, y);
            const float z = frame.live_m[at];
            if (z <= 0.0f || frame.labels[at] >= 0 || mean.samples[i] == 255) continue;
            ++mean.samples[i];
            mean.depth_m[i] += (z - mean.depth_m[i]) / static_cast<float>(mean.samples[i]);
        }
    }
    ++track.frames;
}

/// Nothing of the foreground beside it: a hand that still holds the thing may hide a part.
bool UncoveredSurfaces::is_alone(const Track& track, const ObjectFrame& frame) const {
    const PixelRegion& box = track.surface.mean.box;
    for (int y = box.y0; y < box.y1; ++y) {
        for (int x = box.x0; x < box.x1; ++x) {
            if (frame.labels[map_index(frame.shape, x, y)] < 0) continue;
            for (const int dy : {-apart_px, 0, apart_px}) {
                for (const int dx : {-apart_px, 0, apart_px})
                    if (track.surface.is_inside(x + dx, y + dy)) return false;
            }
        }
    }
    return true;
}

/// Takes in pixels beside it that the mean shows to be behind the background, too: near its foot the thing
/// stood only a little in front of what is seen now.
void UncoveredSurfaces::grow(UncoveredSurface& surface, const ObjectFrame& frame) const {
    const DepthPatch& mean = surface.mean;
    std::vector<Step> open;
    for (int y = mean.box.y0; y < mean.box.y1; ++y) {
        for (int x = mean.box.x0; x < mean.box.x1; ++x)
            if (surface.is_inside(x, y)) open.emplace_back(x, y);
    }
    while (!open.empty()) {
        const auto [from_x, from_y] = open.back();
        open.pop_back();
        for (const auto& [dx, dy] : neighbours) {
            const int x = from_x + dx, y = from_y + dy;
            if (surface.is_inside(x, y) || mean.at(x, y) <= 0.0f) continue;
            const float before_m = frame.predicted_m[map_index(frame.shape, x, y)], now_m = mean.at(x, y);
            const float least_m =
                depth_tolerance_m(config_.noise, config_.quantisation_per_m, growth_sigmas, now_m);
            if (before_m <= 0.0f || now_m - before_m < least_m) continue;
            surface.inside[mean.index(x, y)] = 1;
            open.emplace_back(x, y);
        }
    }
}

}  // namespace touchstone
