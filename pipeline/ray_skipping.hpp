#pragma once

#include <Eigen/Core>
#include <vector>

#include "pipeline/tsdf_volume.hpp"

namespace touchstone {

/// Where rays that start anywhere need not look: they meet surfaces only in bricks that hold a point behind
/// one, or beside those.
class RaySkipping {
  public:
    explicit RaySkipping(const Device& device);

    /// To be called when the volume may have changed. Waits for the device.
    void update(const TsdfVolume& volume);
    /// Of each brick of the cube its slot where a ray may meet a surface in it, else SKIP_BRICK, or
    /// SKIP_GROUP where that holds for its whole group of SKIP_GROUP_BRICKS^3.
    const Buffer<int>& table() const { return table_; }

    /// The box that holds all bricks that have a slot in the table, voxels; low is not less than high where
    /// there is none.
    const Eigen::Vector3f& low_vox() const { return low_vox_; }
    const Eigen::Vector3f& high_vox() const { return high_vox_; }

  private:
    void find_bounds(int bricks_per_side);

    const Device* device_;
    std::vector<int> inside_;
    Buffer<int> table_;
    Eigen::Vector3f low_vox_, high_vox_;
};

}  // namespace touchstone
