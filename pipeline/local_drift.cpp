#include "pipeline/local_drift.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace touchstone {

namespace {

/// Background far enough from the foreground and the picture's border.
bool is_clear(const TablePicture& picture, int x, int y, int gap_px) {
    if (!in_picture(picture, x - gap_px, y - gap_px) || !in_picture(picture, x + gap_px, y + gap_px))
        return false;
    const auto masked = [&](int i, int j) { return picture.mask[index_of(picture, x + i, y + j)] != 0; };
    return !masked(0, 0) && !masked(-gap_px, 0) && !masked(gap_px, 0) && !masked(0, -gap_px) &&
           !masked(0, gap_px);
}

}  // namespace

float local_drift_m(const TablePicture& picture, const SurfacePoint& middle, const LocalDriftConfig& config) {
    const Eigen::Vector2f pixel = project(picture.intrinsics, middle.point_c_m);
    const int cx = static_cast<int>(std::lround(pixel.x())), cy = static_cast<int>(std::lround(pixel.y()));
    const float px_per_m = picture.intrinsics.fx_px / middle.point_c_m.z();
    const int outer_px = static_cast<int>(config.outer_m * px_per_m);
    const int inner2 = static_cast<int>(config.inner_m * config.inner_m * px_per_m * px_per_m);
    std::vector<float> heights_m;
    for (int dy = -outer_px; dy <= outer_px; dy += 2) {
        for (int dx = -outer_px; dx <= outer_px; dx += 2) {
            const int r2 = dx * dx + dy * dy, x = cx + dx, y = cy + dy;
            if (r2 < inner2 || r2 > outer_px * outer_px || !is_clear(picture, x, y, config.clear_px))
                continue;
            const float z = picture.live_m[index_of(picture, x, y)];
            const SurfacePoint surface = background_at(picture, x, y);
            if (z <= 0.0f || !surface.known) continue;
            heights_m.push_back(
                surface.normal_c.dot(back_project(picture.intrinsics, x, y, z) - surface.point_c_m));
        }
    }
    if (static_cast<int>(heights_m.size()) < config.least_pixels) return 0.0f;
    const auto half = heights_m.begin() + static_cast<std::ptrdiff_t>(heights_m.size() / 2);
    std::ranges::nth_element(heights_m, half);
    return std::abs(*half) <= config.most_m ? *half : 0.0f;
}

}  // namespace touchstone
