#include "pipeline/scan_file.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "platform/system/byte_stream.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

namespace {

static_assert(sizeof(VolumeConfig) == 28, "write a new member here too, and raise the version of the format");

void put_pose(ByteWriter& out, const RigidTransform& T) {
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) out.put(T.matrix()(row, column));
    }
}

RigidTransform get_pose(ByteReader& in) {
    RigidTransform T = RigidTransform::Identity();
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) T.matrix()(row, column) = in.get<float>();
    }
    return T;
}

void put_config(ByteWriter& out, const VolumeConfig& config) {
    out.put(std::int32_t{config.size_vox});
    for (const float value :
         {config.side_m, config.max_truncation_vox, config.min_truncation_vox, config.min_truncation_m})
        out.put(value);
    out.put(std::int32_t{config.max_weight});
    out.put(std::int32_t{config.max_bricks});
}

VolumeConfig get_config(ByteReader& in) {
    VolumeConfig config;
    config.size_vox = in.get<std::int32_t>();
    for (float* value :
         {&config.side_m, &config.max_truncation_vox, &config.min_truncation_vox, &config.min_truncation_m})
        *value = in.get<float>();
    config.max_weight = in.get<std::int32_t>();
    config.max_bricks = in.get<std::int32_t>();
    return config;
}

void put_intrinsics(ByteWriter& out, const Intrinsics& k) {
    for (const float value : {k.fx_px, k.fy_px, k.cx_px, k.cy_px}) out.put(value);
    out.put(std::int32_t{k.width_px});
    out.put(std::int32_t{k.height_px});
}

Intrinsics get_intrinsics(ByteReader& in) {
    Intrinsics k{};
    for (float* value : {&k.fx_px, &k.fy_px, &k.cx_px, &k.cy_px}) *value = in.get<float>();
    k.width_px = in.get<std::int32_t>();
    k.height_px = in.get<std::int32_t>();
    return k;
}

/// Differences are mostly 1 and compress to nothing.
void put_bricks(ByteWriter& out, const std::vector<int>& bricks) {
    std::vector<std::uint32_t> steps;
    std::uint32_t last = 0;
    for (const int brick : bricks) {
        steps.push_back(static_cast<std::uint32_t>(brick) - last);
        last = static_cast<std::uint32_t>(brick);
    }
    out.put_planes(std::span<const std::uint32_t>(steps));
}

std::vector<int> get_bricks(ByteReader& in, std::size_t count) {
    std::vector<int> bricks;
    std::uint32_t last = 0;
    for (const std::uint32_t step : in.get_planes<std::uint32_t>(count)) {
        last += step;
        bricks.push_back(static_cast<int>(last));
    }
    return bricks;
}

std::string encode(const SavedScan& scan) {
    const VolumeSnapshot& volume = scan.volume;
    ByteWriter out;
    put_config(out, volume.config);
    put_intrinsics(out, scan.intrinsics);
    put_pose(out, scan.T_g_c);
    for (const std::size_t count : {volume.bricks.size(), volume.color_bricks.size(), scan.keyframes.size()})
        out.put(static_cast<std::uint32_t>(count));
    put_bricks(out, volume.bricks);
    out.put_planes(std::span(volume.voxels));
    put_bricks(out, volume.color_bricks);
    out.put_planes(std::span(volume.colors));
    for (const Keyframe& keyframe : scan.keyframes) {
        put_pose(out, keyframe.T_g_c);
        out.put_bytes(keyframe.code);
    }
    return out.take();
}

SavedScan decode(std::string_view content) {
    ByteReader in(content);
    SavedScan scan;
    scan.volume.config = get_config(in);
    scan.intrinsics = get_intrinsics(in);
    scan.T_g_c = get_pose(in);
    const std::size_t bricks = in.get<std::uint32_t>(), color_bricks = in.get<std::uint32_t>(),
                      keyframes = in.get<std::uint32_t>();
    scan.volume.bricks = get_bricks(in, bricks);
    scan.volume.voxels = in.get_planes<std::int32_t>(bricks * BRICK_VOXELS);
    scan.volume.color_bricks = get_bricks(in, color_bricks);
    scan.volume.colors = in.get_planes<std::uint32_t>(color_bricks * BRICK_VOXELS);
    for (std::size_t i = 0; i < keyframes; ++i) {
        Keyframe keyframe;
        keyframe.T_g_c = get_pose(in);
        in.get_bytes(keyframe.code);
        scan.keyframes.push_back(keyframe);
    }
    if (in.remaining() > 0) throw Error(ExitStatus::bad_data, "there is more in it than there should be");
    return scan;
}

bool within(float value, float low, float high) { return value >= low && value <= high; }

bool is_ascending(const std::vector<int>& bricks) {
    return std::ranges::adjacent_find(bricks, std::greater_equal{}) == bricks.end();
}

bool is_sound(const VolumeConfig& config) {
    return config.size_vox >= BRICK_VOX && config.size_vox <= 2048 && config.size_vox % BRICK_VOX == 0 &&
           within(config.side_m, 0.01f, 1000.0f) && within(config.max_truncation_vox, 0.0f, 1000.0f) &&
           within(config.min_truncation_vox, 0.0f, 1000.0f) &&
           within(config.min_truncation_m, 0.0f, 1000.0f) && config.max_weight >= 1 &&
           config.max_weight <= 255 && config.max_bricks >= 1 && config.max_bricks <= scan_max_bricks;
}

bool bricks_fit(const VolumeSnapshot& volume) {
    const std::int64_t side = volume.config.size_vox / BRICK_VOX;
    const bool inside =
        volume.bricks.empty() || (volume.bricks.front() >= 0 && volume.bricks.back() < side * side * side);
    return inside && is_ascending(volume.bricks) && is_ascending(volume.color_bricks) &&
           std::ranges::includes(volume.bricks, volume.color_bricks) &&
           volume.bricks.size() <= static_cast<std::size_t>(volume.config.max_bricks) &&
           volume.voxels.size() == volume.bricks.size() * BRICK_VOXELS &&
           volume.colors.size() == volume.color_bricks.size() * BRICK_VOXELS;
}

bool is_sound(const Intrinsics& k) {
    return within(k.fx_px, 1.0f, 1e5f) && within(k.fy_px, 1.0f, 1e5f) && within(k.cx_px, -1e5f, 1e5f) &&
           within(k.cy_px, -1e5f, 1e5f) && k.width_px >= 1 && k.width_px <= 16384 && k.height_px >= 1 &&
           k.height_px <= 16384;
}

bool is_sound(const RigidTransform& T) {
    const Eigen::Matrix3f R = T.linear();
    return (R.transpose() * R - Eigen::Matrix3f::Identity()).norm() < 0.01f && R.determinant() > 0.0f &&
           T.translation().norm() < 1e4f;
}

void check(const SavedScan& scan) {
    const auto demand = [](bool sound, const char* otherwise) {
        if (!sound) throw Error(ExitStatus::bad_data, otherwise);
    };
    demand(is_sound(scan.volume.config), "its volume has a size that none can have");
    demand(bricks_fit(scan.volume), "its bricks do not fit its volume");
    demand(is_sound(scan.intrinsics), "its camera is none");
    demand(is_sound(scan.T_g_c), "its camera's pose is none");
    demand(scan.keyframes.size() <= scan_max_keyframes, "it has too many keyframes");
    demand(std::ranges::all_of(scan.keyframes, [](const Keyframe& frame) { return is_sound(frame.T_g_c); }),
           "a keyframe's pose is none");
}

}  // namespace

void save_scan(const std::filesystem::path& path, const SavedScan& scan) {
    try {
        check(scan);
    } catch (const Error& error) {
        throw Error(error.status(), path.string() + " is not written: " + error.what());
    }
    write_checked_file(path, scan_file_format, encode(scan));
}

SavedScan load_scan(const std::filesystem::path& path) {
    const std::string content = read_checked_file(path, scan_file_format);
    try {
        SavedScan scan = decode(content);
        check(scan);
        return scan;
    } catch (const Error& error) {
        throw Error(error.status(), path.string() + " is no good scan: " + error.what() + "; take a new one");
    }
}

}  // namespace touchstone
