#include "tests/accuracy/foreground_score.hpp"

#include <algorithm>
#include <cmath>

namespace touchstone {

namespace {

constexpr int edge_px = 3, window_px = 7, least_window = 60;
constexpr float edge_step_m = 0.015f;
constexpr int tip_window_px = 14;
constexpr double most_tip_error_m = 0.02;

std::size_t index(const Intrinsics& k, int x, int y) { return static_cast<std::size_t>(y * k.width_px + x); }

bool shows_hand(const sim::Picture& truth, std::size_t pixel, int owner) {
    return truth.part[pixel] > 0 && truth.owner[pixel] == owner;
}

/// Away from the silhouette and from steps between parts.
bool is_interior(const Intrinsics& k, const sim::Picture& truth, int owner, int x, int y) {
    if (x < edge_px || y < edge_px || x >= k.width_px - edge_px || y >= k.height_px - edge_px) return false;
    const float here_m = truth.depth_m[index(k, x, y)];
    for (int j = -edge_px; j <= edge_px; ++j) {
        for (int i = -edge_px; i <= edge_px; ++i) {
            const std::size_t pixel = index(k, x + i, y + j);
            if (!shows_hand(truth, pixel, owner) || std::abs(truth.depth_m[pixel] - here_m) > edge_step_m)
                return false;
        }
    }
    return true;
}

/// Sums over rectangles of a picture.
class SumTable {
  public:
    SumTable(const Intrinsics& k, const std::vector<double>& values)
        : width_(k.width_px + 1), sums_(static_cast<std::size_t>(width_ * (k.height_px + 1)), 0.0) {
        for (int y = 0; y < k.height_px; ++y) {
            double row = 0.0;
            for (int x = 0; x < k.width_px; ++x) {
                row += values[index(k, x, y)];
                at(x + 1, y + 1) = at(x + 1, y) + row;
            }
        }
    }
    double around(const Intrinsics& k, int x, int y) {
        const int x0 = std::max(0, x - window_px), x1 = std::min(k.width_px, x + window_px + 1);
        const int y0 = std::max(0, y - window_px), y1 = std::min(k.height_px, y + window_px + 1);
        return at(x1, y1) - at(x0, y1) - at(x1, y0) + at(x0, y0);
    }

  private:
    double& at(int x, int y) { return sums_[static_cast<std::size_t>(y * width_ + x)]; }

    int width_;
    std::vector<double> sums_;
};

void add_residuals(const Intrinsics& k, const std::vector<std::size_t>& interior,
                   const std::vector<double>& errors_m, SumTable& counts, SurfaceErrors& result) {
    SumTable sums(k, errors_m);
    for (const std::size_t pixel : interior) {
        const int x = static_cast<int>(pixel) % k.width_px, y = static_cast<int>(pixel) / k.width_px;
        const double count = counts.around(k, x, y);
        if (count < least_window) continue;
        const double residual_m = errors_m[pixel] - sums.around(k, x, y) / count;
        result.squares_m2 += residual_m * residual_m;
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

void add_surface_errors(const Intrinsics& k, const sim::Picture& truth, int owner,
                        std::span<const ScoredSurface> surfaces) {
    std::vector<std::size_t> interior;
    std::vector<double> is_used(truth.depth_m.size(), 0.0);
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            const std::size_t pixel = index(k, x, y);
            if (!shows_hand(truth, pixel, owner)) continue;
            if (std::ranges::any_of(surfaces, [&](const auto& s) { return s.depth_m[pixel] <= 0.0f; }))
                continue;
            for (const ScoredSurface& surface : surfaces) {
                surface.errors->absolute_m +=
                    static_cast<double>(std::abs(surface.depth_m[pixel] - truth.depth_m[pixel]));
                ++surface.errors->pixels;
            }
            if (!is_interior(k, truth, owner, x, y)) continue;
            is_used[pixel] = 1.0;
            interior.push_back(pixel);
        }
    }
    SumTable counts(k, is_used);
    for (const ScoredSurface& surface : surfaces) {
        std::vector<double> errors_m(truth.depth_m.size(), 0.0);
        for (const std::size_t pixel : interior)
            errors_m[pixel] = static_cast<double>(surface.depth_m[pixel] - truth.depth_m[pixel]);
        add_residuals(k, interior, errors_m, counts, *surface.errors);
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
