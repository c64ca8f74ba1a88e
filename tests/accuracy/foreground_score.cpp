#include "tests/accuracy/foreground_score.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace touchstone {

namespace {

constexpr int edge_px = 3, window_px = 5, least_window = 40, grid_px = 3;
constexpr float edge_step_m = 0.015f;
constexpr int tip_window_px = 14;
constexpr double most_tip_error_m = 0.02;

std::size_t index(const Intrinsics& k, int x, int y) { return static_cast<std::size_t>(y * k.width_px + x); }

bool shows(const sim::Picture& truth, std::size_t pixel, const HandParts& parts) {
    const std::size_t number = truth.part[pixel];
    return number > parts.first && number <= parts.last && truth.owner[pixel] == parts.owner;
}

/// Away from the silhouette and from steps between parts.
bool is_interior(const Intrinsics& k, const sim::Picture& truth, const HandParts& parts, int x, int y) {
    if (x < edge_px || y < edge_px || x >= k.width_px - edge_px || y >= k.height_px - edge_px) return false;
    const float here_m = truth.depth_m[index(k, x, y)];
    for (int j = -edge_px; j <= edge_px; ++j) {
        for (int i = -edge_px; i <= edge_px; ++i) {
            const std::size_t pixel = index(k, x + i, y + j);
            if (!shows(truth, pixel, parts) || std::abs(truth.depth_m[pixel] - here_m) > edge_step_m)
                return false;
        }
    }
    return true;
}

/// What is left of a pixel's error after the plane through the errors around it; nothing where few are known.
std::optional<double> residual_m(const Intrinsics& k, const std::vector<std::uint8_t>& is_used,
                                 const std::vector<double>& errors_m, int x, int y) {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    for (int j = std::max(0, y - window_px); j <= std::min(k.height_px - 1, y + window_px); ++j) {
        for (int i = std::max(0, x - window_px); i <= std::min(k.width_px - 1, x + window_px); ++i) {
            const std::size_t pixel = index(k, i, j);
            if (is_used[pixel] == 0) continue;
            const Eigen::Vector3d row(1.0, i - x, j - y);
            A += row * row.transpose();
            b += row * errors_m[pixel];
        }
    }
    if (A(0, 0) < least_window) return std::nullopt;
    return errors_m[index(k, x, y)] - A.ldlt().solve(b)[0];
}

void add_residuals(const Intrinsics& k, const std::vector<std::size_t>& interior,
                   const std::vector<std::uint8_t>& is_used, const std::vector<double>& errors_m,
                   SurfaceErrors& result) {
    for (const std::size_t pixel : interior) {
        const int x = static_cast<int>(pixel) % k.width_px, y = static_cast<int>(pixel) / k.width_px;
        if (x % grid_px != 0 || y % grid_px != 0) continue;
        const std::optional<double> residual = residual_m(k, is_used, errors_m, x, y);
        if (!residual) continue;
        result.squares_m2 += *residual * *residual;
        ++result.residuals;
    }
}

}  // namespace

double SurfaceErrors::noise_mm() const {
    return residuals > 0 ? 1000.0 * std::sqrt(squares_m2 / static_cast<double>(residuals)) : 0.0;
}

double SurfaceErrors::mean_mm() const {
    return pixels > 0 ? 1000.0 * absolute_m / static_cast<double>(pixels) : 0.0;
}

HandParts arm_parts(int owner, const sim::Hand& hand) {
    // The wrist is bare; the sleeve begins behind it.
    const auto sleeve = std::ranges::find(hand.parts, sim::HandMaterial::sleeve, &sim::HandPart::material);
    const auto first = static_cast<std::size_t>(sleeve - hand.parts.begin()) - 1;
    return {owner, first, hand.parts.size()};
}

HandParts parts_before_the_arm(int owner, const sim::Hand& hand) {
    return {owner, 0, arm_parts(owner, hand).first};
}

void add_surface_errors(const Intrinsics& k, const sim::Picture& truth, const HandParts& parts,
                        std::span<const ScoredSurface> surfaces) {
    std::vector<std::size_t> interior;
    std::vector<std::uint8_t> is_used(truth.depth_m.size(), 0);
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            const std::size_t pixel = index(k, x, y);
            if (!shows(truth, pixel, parts)) continue;
            if (std::ranges::any_of(surfaces, [&](const auto& s) { return s.depth_m[pixel] <= 0.0f; }))
                continue;
            for (const ScoredSurface& surface : surfaces) {
                surface.errors->absolute_m +=
                    static_cast<double>(std::abs(surface.depth_m[pixel] - truth.depth_m[pixel]));
                ++surface.errors->pixels;
            }
            if (!is_interior(k, truth, parts, x, y)) continue;
            is_used[pixel] = 1;
            interior.push_back(pixel);
        }
    }
    for (const ScoredSurface& surface : surfaces) {
        std::vector<double> errors_m(truth.depth_m.size(), 0.0);
        for (const std::size_t pixel : interior)
            errors_m[pixel] = static_cast<double>(surface.depth_m[pixel] - truth.depth_m[pixel]);
        add_residuals(k, interior, is_used, errors_m, *surface.errors);
    }
}

void LagScore::add(const Intrinsics& k, std::span<const float> depth_m,
                   std::span<const sim::Picture* const> truths, const Eigen::Vector2f& tip_px) {
    const int u = static_cast<int>(std::lround(tip_px.x())), v = static_cast<int>(std::lround(tip_px.y()));
    for (int y = std::max(0, v - tip_window_px); y < std::min(k.height_px, v + tip_window_px + 1); ++y) {
        for (int x = std::max(0, u - tip_window_px); x < std::min(k.width_px, u + tip_window_px + 1); ++x) {
            const std::size_t pixel = index(k, x, y);
            if (depth_m[pixel] <= 0.0f) continue;
            for (std::size_t i = 0; i < delays; ++i) {
                const auto error_m =
                    std::abs(static_cast<double>(depth_m[pixel] - truths[i]->depth_m[pixel]));
                const double clipped_m = std::min(error_m, most_tip_error_m);
                squares_[i] += clipped_m * clipped_m;
            }
        }
    }
    ++frames_;
}

double LagScore::lag_frames() const {
    if (frames_ == 0) return 0.0;
    const auto best = static_cast<std::size_t>(std::ranges::min_element(squares_) - squares_.begin());
    const double whole = static_cast<double>(best) - 1.0;
    if (best == 0 || best + 1 == delays) return whole;
    const double before = squares_[best - 1], here = squares_[best], after = squares_[best + 1];
    return whole + 0.5 * (before - after) / (before - 2.0 * here + after);
}

}  // namespace touchstone
