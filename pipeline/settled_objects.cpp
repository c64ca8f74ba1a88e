#include "pipeline/settled_objects.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pipeline/kernel_program.hpp"

namespace touchstone {

namespace {

constexpr int cover_px = 6;
constexpr int most_weight = 60;

/// A cube of whole bricks of the grid around the patch, with what lies a truncation behind it.
std::pair<VolumeConfig, Eigen::Vector3f> cube_around(const DepthPatch& patch, const VolumeConfig& grid,
                                                     const Intrinsics& k, const RigidTransform& T_g_c) {
    const VolumeParams params = make_volume_params(grid);
    Eigen::AlignedBox3f box;
    for (int y = patch.box.y0; y < patch.box.y1; ++y) {
        for (int x = patch.box.x0; x < patch.box.x1; ++x)
            if (const float z = patch.at(x, y); z > 0.0f) box.extend(T_g_c * back_project(k, x, y, z));
    }
    const float brick_m = params.voxel_m * BRICK_VOX;
    const Eigen::Vector3f margin = Eigen::Vector3f::Constant(params.max_truncation_m + params.voxel_m);
    const Eigen::Array3f first = ((box.min() - margin) / brick_m).array().floor();
    const Eigen::Array3f last = ((box.max() + margin) / brick_m).array().ceil();
    const int bricks = std::max(1, static_cast<int>((last - first).maxCoeff()));
    VolumeConfig cube = grid;
    cube.size_vox = std::min(bricks * BRICK_VOX, 2048);
    cube.side_m = static_cast<float>(cube.size_vox) * params.voxel_m;
    cube.max_bricks = std::max(64, bricks * bricks * bricks);
    return {cube, (first * brick_m).matrix()};
}

RigidTransform in_cube(const Eigen::Vector3f& corner_g_m, const RigidTransform& T_g_c) {
    RigidTransform T_o_c = T_g_c;
    T_o_c.translation() -= corner_g_m;
    return T_o_c;
}

}  // namespace

std::vector<Eigen::Vector3f> patch_normals_c(const DepthPatch& patch, const Intrinsics& k) {
    std::vector<Eigen::Vector3f> normals(patch.depth_m.size(), Eigen::Vector3f::Zero());
    for (int y = patch.box.y0; y < patch.box.y1; ++y) {
        for (int x = patch.box.x0; x < patch.box.x1; ++x) {
            const float z = patch.at(x, y);
            if (z <= 0.0f) continue;
            const Eigen::Vector3f here = back_project(k, x, y, z);
            const auto slope = [&](int dx, int dy) -> Eigen::Vector3f {
                Eigen::Vector3f sum = Eigen::Vector3f::Zero();
                for (const int sign : {-1, 1}) {
                    const float next = patch.at(x + sign * dx, y + sign * dy);
                    if (next <= 0.0f || std::abs(next - z) > 0.03f * z) continue;
                    sum += static_cast<float>(sign) *
                           (back_project(k, x + sign * dx, y + sign * dy, next) - here);
                }
                return sum;
            };
            Eigen::Vector3f n = slope(1, 0).cross(slope(0, 1));
            if (n.squaredNorm() <= 0.0f) continue;
            n.normalize();
            normals[patch.index(x, y)] = n.dot(here) > 0.0f ? Eigen::Vector3f(-n) : n;
        }
    }
    return normals;
}

SettledObjects::SettledObjects(const Device& device, const ObjectsConfig& config,
                               const Intrinsics& intrinsics)
    : device_(&device),
      config_(config),
      intrinsics_(intrinsics),
      shape_(make_map_shape(intrinsics)),
      program_(load_kernel_program(device, "settled_objects.cl")),
      lay_over_(program_.kernel("lay_over")),
      integration_(device, intrinsics, config.noise),
      raycasting_(device, intrinsics),
      over_(device, shape_),
      nearest_m_(map_pixels(shape_), 0.0f),
      cover_(map_pixels(shape_), 0) {
    over_.depth_m.fill(0.0f);
    over_.normals_c.fill(0.0f);
}

void SettledObjects::add(const DepthPatch& patch, const VolumeConfig& grid, const RigidTransform& T_g_c) {
    objects_.push_back(make(patch, grid, T_g_c));
    compose();
}

SettledObjects::Object SettledObjects::make(const DepthPatch& patch, const VolumeConfig& grid,
                                            const RigidTransform& T_g_c) {
    const auto [cube, corner_g_m] = cube_around(patch, grid, intrinsics_, T_g_c);
    Object object{TsdfVolume(*device_, cube), corner_g_m, patch, {}};
    fuse(object, patch, T_g_c);
    see(object, &patch, T_g_c);
    return object;
}

void SettledObjects::fuse(Object& object, const DepthPatch& patch, const RigidTransform& T_g_c) {
    Buffer<float> depth_m(*device_, map_pixels(shape_));
    Buffer<std::uint8_t> weights(*device_, map_pixels(shape_));
    depth_m.fill(0.0f);
    weights.fill(0);
    {
        const auto depths = depth_m.map_update();
        const auto samples = weights.map_update();
        for (int y = patch.box.y0; y < patch.box.y1; ++y) {
            for (int x = patch.box.x0; x < patch.box.x1; ++x) {
                const std::size_t from = patch.index(x, y), to = map_index(shape_, x, y);
                if (patch.depth_m[from] <= 0.0f) continue;
                depths[to] = patch.depth_m[from];
                samples[to] = std::min<std::uint8_t>(patch.samples[from], most_weight);
            }
        }
    }
    integration_.integrate(object.volume, depth_m, weights, in_cube(object.corner_g_m, T_g_c),
                           all_layers(object.volume));
}

/// The raycast of its volume; at the rim, where that has no surface, what was measured.
void SettledObjects::see(Object& object, const DepthPatch* measured, const RigidTransform& T_g_c) {
    SurfacePrediction alone(*device_, shape_);
    raycasting_.raycast(object.volume, in_cube(object.corner_g_m, T_g_c), alone);
    const auto depths = alone.depth_m.map_read();
    const auto normals = alone.normals_c.map_read();
    DepthPatch& seen = object.seen;
    if (measured == nullptr) {
        seen = {{intrinsics_.width_px, intrinsics_.height_px, 0, 0}, {}, {}};
        for (int y = 0; y < shape_.height_px; ++y) {
            for (int x = 0; x < shape_.width_px; ++x)
                if (depths[map_index(shape_, x, y)] > 0.0f) seen.box = hull(seen.box, {x, y, x + 1, y + 1});
        }
        if (seen.box.empty()) seen.box = {};
        seen.depth_m.assign(static_cast<std::size_t>(seen.box.width_px() * seen.box.height_px()), 0.0f);
        object.normals_c.assign(seen.depth_m.size(), Eigen::Vector3f::Zero());
    } else {
        seen = *measured;
        object.normals_c = patch_normals_c(seen, intrinsics_);
    }
    const std::size_t plane = map_pixels(shape_);
    for (int y = seen.box.y0; y < seen.box.y1; ++y) {
        for (int x = seen.box.x0; x < seen.box.x1; ++x) {
            const std::size_t from = map_index(shape_, x, y), to = seen.index(x, y);
            if (depths[from] <= 0.0f) continue;
            seen.depth_m[to] = depths[from];
            object.normals_c[to] = {normals[from], normals[plane + from], normals[2 * plane + from]};
        }
    }
}

std::vector<PixelRegion> SettledObjects::drop_taken(const ObjectFrame& frame) {
    std::vector<PixelRegion> boxes;
    std::erase_if(objects_, [&](Object& object) {
        const bool taken = is_taken(object, frame);
        if (taken) boxes.push_back(object.seen.box);
        return taken;
    });
    if (!boxes.empty()) compose();
    return boxes;
}

bool SettledObjects::is_taken(Object& object, const ObjectFrame& frame) const {
    constexpr int rim_px = 2;
    const DepthPatch& seen = object.seen;
    int all = 0, behind = 0;
    for (int y = seen.box.y0; y < seen.box.y1; ++y) {
        for (int x = seen.box.x0; x < seen.box.x1; ++x) {
            const bool inner = seen.at(x, y) > 0.0f && seen.at(x - rim_px, y) > 0.0f &&
                               seen.at(x + rim_px, y) > 0.0f && seen.at(x, y - rim_px) > 0.0f &&
                               seen.at(x, y + rim_px) > 0.0f;
            // What another thing hides says nothing.
            const std::size_t at = map_index(frame.shape, x, y);
            if (!inner || nearest_m_[at] < seen.at(x, y)) continue;
            ++all;
            behind += frame.rejection[at] == ASSOCIATION_BEHIND;
        }
    }
    const auto is_share = [&](float share) {
        return all > 0 && static_cast<float>(behind) >= share * static_cast<float>(all);
    };
    object.taken_frames = is_share(config_.min_taken_share) ? object.taken_frames + 1 : 0;
    object.shifted_frames = is_share(config_.min_shifted_share) ? object.shifted_frames + 1 : 0;
    return object.taken_frames >= config_.taken_frames || object.shifted_frames >= config_.shifted_frames;
}

void SettledObjects::move_camera(const RigidTransform& T_g_c) {
    for (Object& object : objects_) see(object, nullptr, T_g_c);
    if (!objects_.empty()) compose();
}

void SettledObjects::clear() {
    objects_.clear();
    compose();
}

std::size_t SettledObjects::memory_bytes() const {
    std::size_t bytes = 0;
    for (const Object& object : objects_) bytes += object.volume.memory_bytes();
    return bytes;
}

/// The nearest of all objects, and the cover.
void SettledObjects::compose() {
    std::ranges::fill(nearest_m_, 0.0f);
    std::ranges::fill(cover_, std::uint8_t{0});
    const auto normals = over_.normals_c.map_update();
    const std::size_t plane = map_pixels(shape_);
    for (const Object& object : objects_) {
        const DepthPatch& seen = object.seen;
        for (int y = seen.box.y0; y < seen.box.y1; ++y) {
            for (int x = seen.box.x0; x < seen.box.x1; ++x) {
                const std::size_t from = seen.index(x, y), to = map_index(shape_, x, y);
                const float z = seen.depth_m[from];
                if (z <= 0.0f) continue;
                cover_around(x, y);
                if (nearest_m_[to] > 0.0f && nearest_m_[to] <= z) continue;
                nearest_m_[to] = z;
                for (std::size_t axis = 0; axis < 3; ++axis)
                    normals[axis * plane + to] = object.normals_c[from][static_cast<Eigen::Index>(axis)];
            }
        }
    }
    over_.depth_m.write(nearest_m_);
}

void SettledObjects::cover_around(int x, int y) {
    const int left = std::max(0, x - cover_px), right = std::min(x + cover_px + 1, shape_.width_px);
    for (int v = std::max(0, y - cover_px); v <= std::min(y + cover_px, shape_.height_px - 1); ++v)
        std::fill_n(cover_.begin() + static_cast<std::ptrdiff_t>(map_index(shape_, left, v)), right - left,
                    std::uint8_t{255});
}

void SettledObjects::lay_over(SurfacePrediction& prediction) {
    for (const Object& object : objects_) {
        const PixelRegion& box = object.seen.box;
        if (box.empty()) continue;
        const int origin_x = box.x0 / 8 * 8;
        const auto columns = round_up(static_cast<std::size_t>(box.x1 - origin_x), 8) / 8;
        const auto rows = static_cast<std::size_t>(box.height_px());
        lay_over_.launch({{columns, rows, 1}, {1, 1, 1}}, over_.depth_m, over_.normals_c, prediction.depth_m,
                         prediction.normals_c, origin_x, box.y0, shape_);
    }
}

}  // namespace touchstone
