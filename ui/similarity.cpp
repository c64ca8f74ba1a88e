#include "ui/similarity.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace touchstone {
namespace {

using Eigen::Vector2f;

/// Squared pixels: below it all fingers are in one place, and direction and spread mean nothing.
constexpr float min_spread_px2 = 1e-4f;

Vector2f centroid(std::span<const Vector2f> points_px) {
    Vector2f sum(0.f, 0.f);
    for (const Vector2f& point : points_px) sum += point;
    return sum / static_cast<float>(points_px.size());
}

}  // namespace

Vector2f Similarity::operator()(const Vector2f& point_px) const {
    return center_px + translation_px + scale * (Eigen::Rotation2Df(rotation_rad) * (point_px - center_px));
}

Similarity fit_similarity(std::span<const Vector2f> from_px, std::span<const Vector2f> to_px) {
    const std::size_t pairs = std::min(from_px.size(), to_px.size());
    Similarity fit;
    if (pairs == 0) return fit;
    fit.center_px = centroid(from_px.first(pairs));
    const Vector2f to_center = centroid(to_px.first(pairs));
    fit.translation_px = to_center - fit.center_px;

    float dot = 0.f, cross = 0.f, from_spread = 0.f, to_spread = 0.f;
    for (std::size_t i = 0; i < pairs; ++i) {
        const Vector2f a = from_px[i] - fit.center_px;
        const Vector2f b = to_px[i] - to_center;
        dot += a.dot(b);
        cross += a.x() * b.y() - a.y() * b.x();
        from_spread += a.squaredNorm();
        to_spread += b.squaredNorm();
    }
    if (std::min(from_spread, to_spread) < min_spread_px2) return fit;
    fit.scale = std::sqrt(to_spread / from_spread);
    fit.rotation_rad = std::atan2(cross, dot);
    return fit;
}

}  // namespace touchstone
