#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "kernels/shared_types.h"
#include "tests/reference/foreground_segmentation.hpp"

/// What moves apart from the model in plain C++: cell by cell, pixel by pixel. Pictures are row-major without
/// padding.
namespace touchstone::reference {

/// A grid of cells_per_side^3 cells over the cube; see MovingPartsConfig.
struct FreeSpaceParams {
    SensorNoise noise;
    float cell_m;
    int cells_per_side, enough_frames, most_frames;
};

inline float sigma_z_m(const SensorNoise& noise, float z_m) {
    return noise.constant_m + noise.quadratic * (z_m - noise.offset_m) * (z_m - noise.offset_m);
}

/// Over a square of the picture, both of whose sides are at least the largest power of two pixels that the
/// longer one holds; 0 where it is 63 pixels or wider, leaves the picture or has a pixel without depth.
inline float nearest_in_square_m(const Grid<float>& depth_m, float u_px, float v_px, float reach_px) {
    const auto width = static_cast<float>(depth_m.width_px), height = static_cast<float>(depth_m.height_px);
    if (u_px - reach_px < 0.0f || v_px - reach_px < 0.0f || u_px + reach_px >= width ||
        v_px + reach_px >= height || reach_px >= 31.0f)
        return 0.0f;
    const int x0 = static_cast<int>(u_px - reach_px), x1 = static_cast<int>(u_px + reach_px);
    const int y0 = static_cast<int>(v_px - reach_px), y1 = static_cast<int>(v_px + reach_px);
    int window_px = 1;
    while (2 * window_px <= std::max(x1 - x0, y1 - y0) + 1) window_px *= 2;
    float nearest = 1e9f;
    for (int y = std::min(y0, std::max(y1 - window_px + 1, 0)); y <= std::max(y1, y0 + window_px - 1); ++y)
        for (int x = std::min(x0, std::max(x1 - window_px + 1, 0)); x <= std::max(x1, x0 + window_px - 1);
             ++x)
            nearest = std::min(nearest, depth_m.at(x, y));
    return nearest;
}

/// Frames in which a cell was free, and in which there was a surface in it.
struct CellCounts {
    int seen_free, seen_taken;
};

/// The new counts of a cell with its centre at p_c in the camera frame, in which there is a surface or not.
inline CellCounts remember_free_space(const Grid<float>& depth_m, const Grid<std::uint8_t>& moving,
                                      const FreeSpaceParams& space, const Intrinsics& k,
                                      const Eigen::Vector3f& p_c, bool taken_now, const CellCounts& old) {
    if (p_c.z() <= 0.05f) return old;
    const float a = p_c.x() / p_c.z(), b = p_c.y() / p_c.z();
    const float u_px = a * k.fx_px + k.cx_px, v_px = b * k.fy_px + k.cy_px;
    const int x = static_cast<int>(std::floor(u_px + 0.5f)), y = static_cast<int>(std::floor(v_px + 0.5f));
    if (!depth_m.inside(x, y)) return old;
    const float half_m = 0.87f * space.cell_m, far_m = p_c.z() + half_m;
    if (p_c.z() > half_m + 0.05f) {
        const float reach_px = k.fx_px * half_m * (1.0f + 0.5f * (a * a + b * b)) / (p_c.z() - half_m);
        if (nearest_in_square_m(depth_m, u_px, v_px, reach_px) > far_m + 3.0f * sigma_z_m(space.noise, far_m))
            return {std::min(old.seen_free + 1, space.most_frames), old.seen_taken / 2};
    }
    const int seen_taken = std::min(old.seen_taken + (taken_now ? 1 : 0), 255);
    const float seen_m = depth_m.at(x, y);
    const bool taken = seen_m > 0.0f && moving.at(x, y) == 0 &&
                       std::abs(seen_m - p_c.z()) < half_m + sigma_z_m(space.noise, p_c.z());
    return {taken ? std::max(old.seen_free - 2, 0) : old.seen_free, seen_taken};
}

/// Of a point in the global frame; nothing outside the cube.
inline std::optional<std::size_t> cell_index(const FreeSpaceParams& space, const Eigen::Vector3f& p_g) {
    const Eigen::Vector3f cell = p_g / space.cell_m;
    const int n = space.cells_per_side;
    if ((cell.array() < 0.0f).any() || (cell.array() >= static_cast<float>(n)).any()) return std::nullopt;
    const Eigen::Vector3i i = cell.cast<int>();
    return static_cast<std::size_t>((i.z() * n + i.y()) * n + i.x());
}

inline bool in_free_space(const std::vector<std::uint8_t>& seen_free, const FreeSpaceParams& space,
                          const Eigen::Vector3f& p_g) {
    const auto cell = cell_index(space, p_g);
    return cell && seen_free[*cell] >= space.enough_frames;
}

inline Eigen::Vector3f back_project(const Intrinsics& k, int x, int y, float z_m) {
    return {(static_cast<float>(x) - k.cx_px) / k.fx_px * z_m,
            (static_cast<float>(y) - k.cy_px) / k.fy_px * z_m, z_m};
}

/// A live pixel whose cell held a surface in less than young_frames frames.
inline bool is_young(const std::vector<std::uint8_t>& seen_taken, const FreeSpaceParams& space,
                     int young_frames, float live_m, const Eigen::Vector3f& p_g) {
    const auto cell = cell_index(space, p_g);
    return live_m > 0.0f && cell && seen_taken[*cell] < young_frames;
}

/// before_m: nearest depth in the windows of 8 x 8 pixels that begin at a pixel, of the camera b.
inline ComponentMember mark_moving(int code, float live_m, int x, int y,
                                   const std::vector<std::uint8_t>& seen_free, const Grid<float>& before_m,
                                   const FreeSpaceParams& space, bool into_unknown, bool young,
                                   const Intrinsics& k, const Eigen::Isometry3f& T_g_c,
                                   const Eigen::Isometry3f& T_b_c) {
    const bool in_front = code == ASSOCIATION_IN_FRONT || code == ASSOCIATION_SLIGHTLY_IN_FRONT;
    if (!in_front && code != ASSOCIATION_NO_MODEL && code != ASSOCIATION_BEHIND)
        return young ? MEMBER_GROWTH : MEMBER_NONE;
    const Eigen::Vector3f ray((static_cast<float>(x) - k.cx_px) / k.fx_px,
                              (static_cast<float>(y) - k.cy_px) / k.fy_px, 1.0f);
    const Eigen::Vector3f p_g = T_g_c * (live_m * ray), p_b = T_b_c * (live_m * ray);
    const float side_m = space.cell_m * static_cast<float>(space.cells_per_side);
    if (live_m <= 0.0f || (p_g.array() < 0.0f).any() || (p_g.array() >= side_m).any()) return MEMBER_NONE;
    const float margin_m = 4.0f * sigma_z_m(space.noise, live_m);
    const int u = static_cast<int>(std::floor(p_b.x() / p_b.z() * k.fx_px + k.cx_px + 0.5f));
    const int v = static_cast<int>(std::floor(p_b.y() / p_b.z() * k.fy_px + k.cy_px + 0.5f));
    if (p_b.z() > 0.05f && before_m.inside(u, v) && before_m.at(u - 4, v - 4) > p_b.z() + margin_m)
        return MEMBER_SEED;
    const float deeper_m = live_m + std::max(space.cell_m, margin_m);
    if (in_free_space(seen_free, space, p_g) && in_free_space(seen_free, space, T_g_c * (deeper_m * ray)))
        return MEMBER_UNKNOWN;
    const bool grows = in_front || ((into_unknown || young) && code == ASSOCIATION_NO_MODEL);
    return grows ? MEMBER_GROWTH : MEMBER_NONE;
}

/// The new number of frames that a pixel is held; last_m and last_held are of the camera p.
inline int hold_moving(int label, int member, int code, float live_m, int x, int y, const Grid<float>& last_m,
                       const Grid<std::uint8_t>& last_held, const Intrinsics& k,
                       const Eigen::Isometry3f& T_p_c, int hold_frames, const SensorNoise& noise) {
    const bool no_model = code == ASSOCIATION_NO_MODEL;
    const bool in_front = code == ASSOCIATION_IN_FRONT || code == ASSOCIATION_SLIGHTLY_IN_FRONT;
    if (label == 0 || (label == 1 && (in_front || member > MEMBER_GROWTH))) return hold_frames;
    if (!no_model && !in_front && member != MEMBER_GROWTH) return 0;
    const Eigen::Vector3f ray((static_cast<float>(x) - k.cx_px) / k.fx_px,
                              (static_cast<float>(y) - k.cy_px) / k.fy_px, 1.0f);
    const Eigen::Vector3f p = T_p_c * (live_m * ray);
    const int u = static_cast<int>(std::floor(p.x() / p.z() * k.fx_px + k.cx_px + 0.5f));
    const int v = static_cast<int>(std::floor(p.y() / p.z() * k.fy_px + k.cy_px + 0.5f));
    if (live_m <= 0.0f || p.z() <= 0.05f || !last_m.inside(u, v)) return 0;
    const float gap_m = std::max(4.0f * sigma_z_m(noise, live_m), 0.004f);
    int left = 0;
    for (const auto& [dx, dy] : {std::pair{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}})
        if (last_m.inside(u + dx, v + dy) && std::abs(last_m.at(u + dx, v + dy) - p.z()) < gap_m)
            left = std::max(left, last_held.at(u + dx, v + dy) - 1);
    return left;
}

}  // namespace touchstone::reference
