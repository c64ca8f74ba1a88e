#include "pipeline/object_cutting.hpp"

#include <algorithm>
#include <cmath>

namespace touchstone {

namespace {

constexpr int mark_px = 6;
constexpr int rim_px = 3;  // where the thing's outline flickered while it was scanned
constexpr std::int32_t unknown_voxel = 0;

int weight_of(std::int32_t voxel) { return voxel >> 16 & 0xff; }
int tsdf_of(std::int32_t voxel) { return static_cast<std::int16_t>(voxel & 0xffff); }
bool is_free(std::int32_t voxel) { return tsdf_of(voxel) >= static_cast<int>(TSDF_SCALE); }

/// Decides voxel by voxel.
class Cut {
  public:
    Cut(const VolumeParams& volume, const UncoveredSurface& uncovered, const ObjectFrame& frame,
        const RigidTransform& T_g_c)
        : volume_(volume), uncovered_(uncovered), frame_(frame), T_c_g_(T_g_c.inverse()) {}

    Eigen::Vector3f center_g_m(int brick, int voxel) const {
        const int n = volume_.bricks_per_side;
        const Eigen::Vector3i corner(brick % n, brick / n % n, brick / (n * n));
        const Eigen::Vector3i within(voxel & 7, voxel >> 3 & 7, voxel >> 6);
        return ((corner * BRICK_VOX + within).cast<float>().array() + 0.5f).matrix() * volume_.voxel_m;
    }

    /// Whether the rays of the uncovered pixels may pass through the brick.
    bool may_hold(int brick) const {
        const Eigen::Vector3f p_c = T_c_g_ * (0.5f * (center_g_m(brick, 0) + center_g_m(brick, 511)));
        const float radius_m = 0.9f * BRICK_VOX * volume_.voxel_m;
        if (p_c.z() <= radius_m + 0.05f) return false;
        const Intrinsics& k = frame_.intrinsics;
        const float reach_px = radius_m / (p_c.z() - radius_m) * std::max(k.fx_px, k.fy_px) * 1.5f;
        const Eigen::Vector2f at_px = project(k, p_c);
        const PixelRegion& box = uncovered_.mean.box;
        return at_px.x() > static_cast<float>(box.x0) - reach_px &&
               at_px.x() < static_cast<float>(box.x1) + reach_px &&
               at_px.y() > static_cast<float>(box.y0) - reach_px &&
               at_px.y() < static_cast<float>(box.y1) + reach_px;
    }

    bool takes(std::int32_t voxel, const Eigen::Vector3f& center_g_m) const {
        if (weight_of(voxel) == 0 || is_free(voxel)) return false;
        const Eigen::Vector3f p_c = T_c_g_ * center_g_m;
        if (p_c.z() <= 0.05f) return false;
        const Eigen::Vector2f at_px = project(frame_.intrinsics, p_c);
        const int x = static_cast<int>(std::floor(at_px.x() + 0.5f));
        const int y = static_cast<int>(std::floor(at_px.y() + 0.5f));
        if (!uncovered_.mean.box.contains(x, y)) return false;
        const float now_m = uncovered_.mean.at(x, y);
        if (uncovered_.is_inside(x, y)) {
            const float before_m = frame_.predicted_m[map_index(frame_.shape, x, y)];
            const float deepest_m =
                before_m > 0.0f ? before_m + volume_.min_truncation_m + volume_.voxel_m : now_m;
            return p_c.z() < deepest_m;
        }
        if (now_m <= 0.0f || !is_near_inside(x, y)) return false;
        const float clear_m = now_m - p_c.z();
        return clear_m > (tsdf_of(voxel) > 0 ? volume_.max_truncation_m : 2.0f * volume_.voxel_m);
    }

  private:
    bool is_near_inside(int x, int y) const {
        for (int v = y - rim_px; v <= y + rim_px; ++v) {
            for (int u = x - rim_px; u <= x + rim_px; ++u)
                if (uncovered_.is_inside(u, v)) return true;
        }
        return false;
    }

    VolumeParams volume_;
    const UncoveredSurface& uncovered_;
    const ObjectFrame& frame_;
    RigidTransform T_c_g_;
};

}  // namespace

void UncoveredSurface::mark(std::vector<std::uint8_t>& map, const MapShape& shape) const {
    for (int y = mean.box.y0; y < mean.box.y1; ++y) {
        for (int x = mean.box.x0; x < mean.box.x1; ++x) {
            if (!is_inside(x, y)) continue;
            const int left = std::max(0, x - mark_px), right = std::min(x + mark_px + 1, shape.width_px);
            for (int v = std::max(0, y - mark_px); v <= std::min(y + mark_px, shape.height_px - 1); ++v)
                std::fill_n(map.begin() + static_cast<std::ptrdiff_t>(map_index(shape, left, v)),
                            right - left, std::uint8_t{255});
        }
    }
}

VolumeSnapshot cut_out(TsdfVolume& volume, const UncoveredSurface& uncovered, const ObjectFrame& frame,
                       const RigidTransform& T_g_c) {
    const Cut cut(volume.params(), uncovered, frame, T_g_c);
    VolumeSnapshot object;
    object.config = volume.config();
    const VolumeSnapshot before = take_snapshot(volume);
    std::vector<int> slots;
    std::vector<std::int32_t> left;
    for (std::size_t i = 0; i < before.bricks.size(); ++i) {
        const int brick = before.bricks[i];
        if (!cut.may_hold(brick)) continue;
        std::vector<std::int32_t> taken(BRICK_VOXELS, unknown_voxel);
        const std::span<const std::int32_t> voxels =
            std::span(before.voxels).subspan(i * BRICK_VOXELS, BRICK_VOXELS);
        std::vector<std::int32_t> rest(voxels.begin(), voxels.end());
        bool any = false;
        for (int voxel = 0; voxel < BRICK_VOXELS; ++voxel) {
            const auto at = static_cast<std::size_t>(voxel);
            if (!cut.takes(voxels[at], cut.center_g_m(brick, voxel))) continue;
            any = true;
            taken[at] = voxels[at];
            rest[at] = unknown_voxel;
        }
        if (!any) continue;
        object.bricks.push_back(brick);
        object.voxels.insert(object.voxels.end(), taken.begin(), taken.end());
        slots.push_back(volume.slot(brick));
        left.insert(left.end(), rest.begin(), rest.end());
    }
    volume.write(slots, left);
    return object;
}

}  // namespace touchstone
