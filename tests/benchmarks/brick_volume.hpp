#pragma once

#include "tests/benchmarks/bench_stage.hpp"

namespace touchstone {

/// The product's volume on its own, with a stage's frame in it: what DenseVolume is measured against. Each
/// call waits for the device.
class BrickVolume {
  public:
    BrickVolume(const BenchStage& stage, int size_vox);

    /// Weighs the stage's frame and fuses it into all layers.
    void integrate();
    /// The whole view with normals, as after a change of the camera's pose.
    void raycast();
    /// The tiles that see a slice of what integrate() updated, as in each live frame.
    void refresh();

    const TsdfVolume& volume() const { return volume_; }
    /// How many bricks refresh() takes as changed.
    std::size_t slice_bricks() const { return slice_.size(); }

  private:
    const BenchStage* stage_;
    TsdfVolume volume_;
    SampleWeighting weighting_;
    VolumetricIntegration integration_;
    Raycasting raycasting_;
    SurfacePrediction prediction_;
    std::vector<int> slice_;
};

}  // namespace touchstone
