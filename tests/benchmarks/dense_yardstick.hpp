#pragma once

#include "pipeline/maps.hpp"
#include "pipeline/types.hpp"
#include "platform/opencl/program.hpp"

namespace touchstone {

/// A dense TSDF over a cube, swept whole for each frame and cast from the front for each pixel: the paper's
/// way, to measure the product against. Its voxels are 32 bits, like a brick's.
class DenseVolume {
  public:
    /// `size_vox` is a multiple of 8; the cube's corner is the global origin.
    DenseVolume(const Device& device, const Intrinsics& intrinsics, int size_vox, float side_m,
                float truncation_m);

    /// Queues Listing 2 over all voxels.
    void integrate(const Buffer<float>& depth_m, const RigidTransform& T_g_c);
    /// Queues Listing 3 for all pixels, from 0.4 m to the far side of the cube. Normals are of the global
    /// frame.
    void raycast(const RigidTransform& T_g_c, SurfacePrediction& prediction);

    int size_vox() const { return size_vox_; }
    std::size_t memory_bytes() const { return 4 * voxel_count(); }
    const Buffer<int>& voxels() const { return voxels_; }

  private:
    std::size_t voxel_count() const;

    Intrinsics intrinsics_;
    MapShape shape_;
    int size_vox_;
    float voxel_m_, truncation_m_;
    Program program_;
    Kernel integrate_, raycast_;
    Buffer<int> voxels_;
};

}  // namespace touchstone
