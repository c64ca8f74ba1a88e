#pragma once

#include "pipeline/maps.hpp"
#include "platform/opencl/program.hpp"

namespace touchstone {

struct RestingTilesConfig {
    float rest_sigmas = 0.2f;   ///< of the sensor's noise: the mean of a tile that agrees with the model
    float mean_share = 0.125f;  ///< of one frame in that mean, which runs
    int young_frames = 600;     ///< a tile is fused in so many before it may rest
    int period = 61;            ///< a resting tile is fused once in so many; prime: every slice has its turn
};

/// Tells where a fixed camera's background agrees with what is seen, so that fusing more would change
/// nothing: what a frame costs follows from what changes.
class RestingTiles {
  public:
    RestingTiles(const Device& device, const RestingTilesConfig& config, const SensorNoise& noise,
                 const MapShape& shape);

    /// Sets the sample weights of the tiles that rest to 0. `model`: of the same camera.
    void leave_out(const LiveMaps& live, const SurfacePrediction& model,
                   Buffer<std::uint8_t>& sample_weights);
    /// The model or the camera is another: all tiles are young.
    void restart();

  private:
    RestingTilesConfig config_;
    SensorNoise noise_;
    MapShape shape_;
    Program program_;
    Kernel rest_tiles_;
    Buffer<float> means_;  ///< of (live - model) / sigma_z, of each tile
    Buffer<int> ages_;
    int frame_ = 0;
};

}  // namespace touchstone
