#include "tests/benchmarks/dense_yardstick.hpp"

#include <array>

#include "pipeline/kernel_program.hpp"
#include "yardstick_sources.hpp"

namespace touchstone {

namespace {

constexpr float start_m = 0.4f;
constexpr int most_weight = 128;

Program load_yardstick(const Device& device) {
    std::vector<ProgramSource> sources = common_kernel_sources();
    for (const yardstick_sources_file& file : yardstick_sources()) sources.push_back({file.path, file.text});
    return {device, sources};
}

}  // namespace

DenseVolume::DenseVolume(const Device& device, const Intrinsics& intrinsics, int size_vox, float side_m,
                         float truncation_m)
    : intrinsics_(intrinsics),
      shape_(make_map_shape(intrinsics)),
      size_vox_(size_vox),
      voxel_m_(side_m / static_cast<float>(size_vox)),
      truncation_m_(truncation_m),
      program_(load_yardstick(device)),
      integrate_(program_.kernel("dense_integrate")),
      raycast_(program_.kernel("dense_raycast")),
      voxels_(device, voxel_count()) {
    voxels_.fill(0);
}

std::size_t DenseVolume::voxel_count() const {
    const auto n = static_cast<std::size_t>(size_vox_);
    return n * n * n;
}

void DenseVolume::integrate(const Buffer<float>& depth_m, const RigidTransform& T_g_c) {
    const auto n = static_cast<std::size_t>(size_vox_);
    integrate_.launch({{n / 8, n, n}, {n / 8, 1, 1}}, voxels_, size_vox_, voxel_m_, depth_m, shape_,
                      intrinsics_, to_pose(T_g_c.inverse()), truncation_m_, most_weight);
}

void DenseVolume::raycast(const RigidTransform& T_g_c, SurfacePrediction& prediction) {
    const auto pitch = static_cast<std::size_t>(shape_.pitch_px),
               rows = static_cast<std::size_t>(shape_.rows_px);
    raycast_.launch({{pitch, rows, 1}, {TILE_PX, 1, 1}}, voxels_, size_vox_, voxel_m_, prediction.depth_m,
                    prediction.normals_c, shape_, intrinsics_, to_pose(T_g_c), truncation_m_, start_m);
}

}  // namespace touchstone
