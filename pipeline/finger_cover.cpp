#include "pipeline/finger_cover.hpp"

#include <algorithm>
#include <cmath>

namespace touchstone {

bool is_covered(const TablePicture& picture, const FingerShape& shape, const FingerCoverConfig& config) {
    const float z_m = shape.center_m.z();
    if (!(z_m > 0.05f)) return true;
    const Eigen::Vector2f center = project(picture.intrinsics, shape.center_m);
    const float radius_px = std::max(1.0f, shape.radius_m * picture.intrinsics.fx_px / z_m);
    const float nearest_m = z_m - shape.radius_m - config.before_m;
    const int reach = static_cast<int>(radius_px);
    const int cx = static_cast<int>(std::lround(center.x())), cy = static_cast<int>(std::lround(center.y()));
    int pixels = 0, hidden = 0;
    for (int dy = -reach; dy <= reach; ++dy) {
        for (int dx = -reach; dx <= reach; ++dx) {
            if (dx * dx + dy * dy > reach * reach) continue;
            ++pixels;
            const int x = cx + dx, y = cy + dy;
            const float live_m = in_picture(picture, x, y) ? picture.live_m[index_of(picture, x, y)] : 0.0f;
            hidden += live_m < nearest_m;
        }
    }
    return static_cast<float>(hidden) >= config.share * static_cast<float>(pixels);
}

}  // namespace touchstone
