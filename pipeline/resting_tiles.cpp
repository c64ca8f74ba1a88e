#include "pipeline/resting_tiles.hpp"

#include "pipeline/kernel_program.hpp"

namespace touchstone {

RestingTiles::RestingTiles(const Device& device, const RestingTilesConfig& config, const SensorNoise& noise,
                           const MapShape& shape)
    : config_(config),
      noise_(noise),
      shape_(shape),
      program_(load_kernel_program(device, "resting_tiles.cl")),
      rest_tiles_(program_.kernel("rest_tiles")),
      means_(device, static_cast<std::size_t>(tile_count(shape))),
      ages_(device, static_cast<std::size_t>(tile_count(shape))) {
    restart();
}

void RestingTiles::restart() {
    means_.fill(0.0f);
    ages_.fill(0);
}

void RestingTiles::leave_out(const LiveMaps& live, const SurfacePrediction& model,
                             Buffer<std::uint8_t>& sample_weights) {
    const LaunchSize size{{static_cast<std::size_t>(tiles_per_row(shape_)),
                           static_cast<std::size_t>(shape_.rows_px / TILE_PX), 1}};
    rest_tiles_.launch(size, live.depth_m, model.depth_m, sample_weights, means_, ages_, shape_, noise_,
                       config_.mean_share, config_.rest_sigmas, config_.young_frames, config_.period, frame_);
    frame_ = (frame_ + 1) % config_.period;
}

}  // namespace touchstone
