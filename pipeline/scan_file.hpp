#pragma once

#include <filesystem>
#include <vector>

#include "pipeline/keyframes.hpp"
#include "pipeline/types.hpp"
#include "pipeline/volume_snapshot.hpp"
#include "platform/system/checked_file.hpp"

namespace touchstone {

/// A model and what is needed to find oneself in it again.
struct SavedScan {
    VolumeSnapshot volume;
    Intrinsics intrinsics{};                            ///< of the camera that made it
    RigidTransform T_g_c = RigidTransform::Identity();  ///< of the fixed camera; else the last one
    std::vector<Keyframe> keyframes;
};

inline constexpr int scan_max_bricks = 1 << 20;
inline constexpr int scan_max_keyframes = 100'000;

/// The content of a scan file, little endian, without gaps; a pose is its 3x4 matrix row by row:
///
///     volume      i32 size_vox; f32 side_m, max_truncation_vox, min_truncation_vox, min_truncation_m;
///                 i32 max_weight, max_bricks
///     camera      f32 fx, fy, cx, cy px; i32 width, height px; 12 f32 T_g_c
///     counts      u32 n bricks, m bricks with colours, k keyframes
///     bricks      n i32 as planes: each index less the one before it (the first: less 0)
///     voxels      512 n i32 as planes
///     colours     m i32 as the bricks; 512 m u32 as planes
///     keyframes   k times 12 f32 T_g_c and 500 bytes of fern code
///
/// Planes: the lowest byte of all values, then their second bytes, third, fourth.
inline constexpr FileFormat scan_file_format{"scan",
                                             {'T', 'O', 'U', 'C', 'H', 'S', 'C', 'N'},
                                             1,
                                             std::uint64_t{scan_max_bricks} * 2 * (4 * BRICK_VOXELS + 4) +
                                                 std::uint64_t{scan_max_keyframes} * (48 + fern_count) + 112};

/// Whole or not at all; equal scans give equal files. Throws Error{io_error}, Error{bad_data} where load_scan
/// would refuse it.
void save_scan(const std::filesystem::path& path, const SavedScan& scan);

/// Throws Error as read_checked_file, and Error{bad_data} where the content makes no volume. Each message is
/// one line that names the file.
SavedScan load_scan(const std::filesystem::path& path);

}  // namespace touchstone
