#include "pipeline/projector_crosses.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "pipeline/homography.hpp"

namespace touchstone {

using Eigen::Vector2f;

namespace {

/// Of the picture; the last four are shown only when the first are not enough.
constexpr std::array<std::array<float, 2>, 8> first_places{{{0.35f, 0.35f},
                                                            {0.65f, 0.35f},
                                                            {0.65f, 0.65f},
                                                            {0.35f, 0.65f},
                                                            {0.5f, 0.5f},
                                                            {0.5f, 0.25f},
                                                            {0.25f, 0.5f},
                                                            {0.75f, 0.5f}}};
/// Of the area, around it; its corners first, for what stands out takes the place of the rest.
constexpr std::array<std::array<float, 2>, 8> later_places{{{0.1f, 0.12f},
                                                            {0.9f, 0.12f},
                                                            {0.9f, 0.88f},
                                                            {0.1f, 0.88f},
                                                            {0.5f, 0.08f},
                                                            {0.92f, 0.5f},
                                                            {0.5f, 0.92f},
                                                            {0.08f, 0.5f}}};
constexpr std::size_t least_matches = 4;

constexpr int look_px = 8;                // between places looked at, and around each
constexpr float least_height_m = 0.012f;  // over or under the plane
constexpr float even_m = 0.012f;          // so much may the height change around a place that is touched
constexpr float apart_m = 0.1f;
constexpr std::size_t most_places = 4;

struct Place {
    Eigen::Vector3f point_g_m;
    float height_m;
};

/// Over the plane of the area; nothing where the surface around is not seen or too steep.
std::optional<Place> even_place(std::span<const Eigen::Vector4f> points_g_m, int width_px, int x_px, int y_px,
                                const InteractiveArea& area_g) {
    const Eigen::Vector3f normal = area_g.axis_u_c_m.cross(area_g.axis_v_c_m).normalized();
    const auto height_m = [&](int x, int y) {
        const Eigen::Vector4f& point = points_g_m[static_cast<std::size_t>(y * width_px + x)];
        return point.w() == 0.0f ? std::optional<float>() : normal.dot(point.head<3>() - area_g.origin_c_m);
    };
    const auto middle = height_m(x_px, y_px);
    if (!middle) return std::nullopt;
    for (const int dy : {-look_px, 0, look_px}) {
        for (const int dx : {-look_px, 0, look_px}) {
            const auto around = height_m(x_px + dx, y_px + dy);
            if (!around || std::abs(*around - *middle) > even_m) return std::nullopt;
        }
    }
    const Eigen::Vector3f point_g_m = points_g_m[static_cast<std::size_t>(y_px * width_px + x_px)].head<3>();
    const Vector2f uv = area_uv(area_g, point_g_m);
    const bool inside = uv.minCoeff() > 0.06f && uv.maxCoeff() < 0.94f;
    return inside ? std::optional(Place{point_g_m, std::abs(*middle)}) : std::nullopt;
}

}  // namespace

std::vector<Eigen::Vector3f> standing_out(std::span<const Eigen::Vector4f> points_g_m, int width_px,
                                          const InteractiveArea& area_g) {
    const int height_px = static_cast<int>(points_g_m.size()) / width_px;
    std::vector<Place> places;
    for (int y = look_px; y + look_px < height_px; y += look_px)
        for (int x = look_px; x + look_px < width_px; x += look_px)
            if (const auto place = even_place(points_g_m, width_px, x, y, area_g);
                place && place->height_m > least_height_m)
                places.push_back(*place);
    std::ranges::sort(places, std::greater(), &Place::height_m);
    std::vector<Eigen::Vector3f> chosen;
    for (const Place& place : places) {
        const bool apart = std::ranges::all_of(
            chosen, [&](const Eigen::Vector3f& other) { return (place.point_g_m - other).norm() > apart_m; });
        if (apart && chosen.size() < most_places) chosen.push_back(place.point_g_m);
    }
    return chosen;
}

ProjectorCrosses::ProjectorCrosses(int width_px, int height_px, const InteractiveArea& area_g,
                                   std::vector<Eigen::Vector3f> standing_out_g_m,
                                   const ProjectorCrossesConfig& config)
    : size_px_(static_cast<float>(width_px), static_cast<float>(height_px)),
      area_g_(area_g),
      standing_out_g_m_(std::move(standing_out_g_m)),
      config_(config) {
    for (const auto& [x, y] : first_places) crosses_px_.push_back(size_px_.cwiseProduct(Vector2f(x, y)));
}

std::optional<Vector2f> ProjectorCrosses::cross_px() const {
    if (next_ >= wanted()) return std::nullopt;
    return crosses_px_[static_cast<std::size_t>(next_)];
}

void ProjectorCrosses::take(std::span<const TouchEvent> touches, const RigidTransform& T_g_c,
                            std::uint64_t timestamp_us) {
    if (!since_us_) since_us_ = timestamp_us;
    if (!touches.empty()) since_us_ = timestamp_us;
    for (const EndedContact& contact : contacts_.take(touches)) {
        const auto cross = cross_px();
        if (!cross) return;
        if (contact.drag_m > config_.most_drag_m) {
            remark_ = "That finger moved: touch, hold still, lift.";
            continue;
        }
        const Eigen::Vector3f touched_g_m = T_g_c * contact.mean.surface_c_m;
        if (last_touched_g_m_ && (touched_g_m - *last_touched_g_m_).norm() < config_.apart_m) continue;
        last_touched_g_m_ = touched_g_m;
        keep({touched_g_m, *cross});
        go_on(timestamp_us);
    }
    const auto waited_us = static_cast<double>(timestamp_us - *since_us_);
    if (cross_px() && waited_us > 1e6 * static_cast<double>(config_.patience_s)) go_on(timestamp_us);
}

void ProjectorCrosses::go_on(std::uint64_t timestamp_us) {
    remark_.clear();
    since_us_ = timestamp_us;
    ++next_;
    if (!is_spread_ && matches_.size() >= least_matches) spread();
    if (next_ == wanted() && is_spread_) show_again();
}

/// Without those that nobody could reach.
void ProjectorCrosses::show_again() {
    if (std::exchange(is_second_round_, true)) return;
    for (const ProjectorMatch& match : matches_) crosses_px_.push_back(match.pixel_px);
}

/// A single touch is some 2 mm off: the mean of two is nearer, unless one of them was meant otherwise.
void ProjectorCrosses::keep(const ProjectorMatch& match) {
    const auto before = std::ranges::find_if(matches_, [&](const ProjectorMatch& other) {
        return other.pixel_px == match.pixel_px &&
               (other.point_g_m - match.point_g_m).norm() < config_.same_m;
    });
    if (before == matches_.end())
        matches_.push_back(match);
    else
        before->point_g_m = 0.5f * (before->point_g_m + match.point_g_m);
}

/// What was touched tells where the area's edges lie in the picture.
void ProjectorCrosses::spread() {
    std::vector<PlaneMatch> places;
    for (const ProjectorMatch& match : matches_)
        places.push_back({area_uv(area_g_, match.point_g_m).cast<double>(), match.pixel_px.cast<double>()});
    const auto H = fit_homography(places);
    if (!H) return;  // three on a line: another of the first may help
    is_spread_ = true;
    crosses_px_.resize(static_cast<std::size_t>(next_));
    const Vector2f free_px = config_.margin * size_px_;
    std::vector<Vector2f> places_uv;
    places_uv.reserve(later_places.size() + standing_out_g_m_.size());
    const std::size_t around = later_places.size() - std::min(later_places.size(), standing_out_g_m_.size());
    for (const auto& [u, v] : std::span(later_places).first(around)) places_uv.emplace_back(u, v);
    for (const Eigen::Vector3f& point : standing_out_g_m_) places_uv.push_back(area_uv(area_g_, point));
    for (const Vector2f& uv : places_uv) {
        const Eigen::Vector3d h = *H * uv.cast<double>().homogeneous();
        if (h.z() <= 0.0) continue;
        const Vector2f at_px = h.hnormalized().cast<float>();
        crosses_px_.push_back(at_px.cwiseMax(free_px).cwiseMin(size_px_ - free_px));
    }
}

std::string ProjectorCrosses::words() const {
    const std::string what = "Touch the cross with one finger, and lift it.";
    return remark_.empty() ? what : remark_ + " " + what;
}

}  // namespace touchstone
