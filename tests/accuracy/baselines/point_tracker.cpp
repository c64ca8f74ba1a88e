#include "tests/accuracy/baselines/point_tracker.hpp"

#include <algorithm>

namespace touchstone::baselines {
namespace {

struct Pair {
    double distance_px;
    std::size_t track, point;
};

}  // namespace

std::vector<int> PointTracker::follow(const std::vector<Eigen::Vector2d>& points_px) {
    std::vector<Pair> pairs;
    for (std::size_t t = 0; t < tracks_.size(); ++t)
        for (std::size_t p = 0; p < points_px.size(); ++p) {
            const double distance_px = (tracks_[t].pixel_px - points_px[p]).norm();
            if (distance_px <= gate_px_) pairs.push_back({distance_px, t, p});
        }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.distance_px < b.distance_px; });
    std::vector<int> ids(points_px.size(), 0);
    for (Track& track : tracks_) ++track.missing;
    for (const Pair& pair : pairs) {
        Track& track = tracks_[pair.track];
        if (track.missing == 0 || ids[pair.point] != 0) continue;
        track.missing = 0;
        track.pixel_px = points_px[pair.point];
        ids[pair.point] = track.id;
    }
    std::erase_if(tracks_, [&](const Track& track) { return track.missing > missing_frames_; });
    for (std::size_t p = 0; p < points_px.size(); ++p) {
        if (ids[p] != 0) continue;
        ids[p] = next_id_++;
        tracks_.push_back({ids[p], points_px[p], 0});
    }
    return ids;
}

bool PointTracker::knows(int id) const {
    return std::any_of(tracks_.begin(), tracks_.end(), [id](const Track& track) { return track.id == id; });
}

std::vector<PixelTouch> follow(PointTracker& tracker, const std::vector<Eigen::Vector2d>& points_px) {
    const std::vector<int> ids = tracker.follow(points_px);
    std::vector<PixelTouch> touches;
    for (std::size_t i = 0; i < ids.size(); ++i) touches.push_back({ids[i], points_px[i]});
    return touches;
}

}  // namespace touchstone::baselines
