#include "tests/benchmarks/brick_volume.hpp"

namespace touchstone {

namespace {

constexpr int refresh_parts = 8, middle_part = 4;

VolumeConfig config_of(int size_vox) {
    VolumeConfig config;
    config.size_vox = size_vox;
    config.side_m = bench_side_m;
    return config;
}

}  // namespace

BrickVolume::BrickVolume(const BenchStage& stage, int size_vox)
    : stage_(&stage),
      volume_(stage.device(), config_of(size_vox)),
      weighting_(stage.device(), SampleWeightConfig{}, stage.intrinsics()),
      integration_(stage.device(), stage.intrinsics()),
      raycasting_(stage.device(), stage.intrinsics()),
      prediction_(stage.device(), stage.shape()) {
    integrate();
    slice_ =
        integration_.integrate(volume_, stage.live().depth_m, weighting_.weigh(stage.live()),
                               stage.background().T_g_c(), layer_share(volume_, middle_part, refresh_parts));
    raycast();
}

void BrickVolume::integrate() {
    integration_.integrate(volume_, stage_->live().depth_m, weighting_.weigh(stage_->live()),
                           stage_->background().T_g_c(), all_layers(volume_));
    stage_->device().finish();
}

void BrickVolume::raycast() {
    raycasting_.raycast(volume_, stage_->background().T_g_c(), prediction_);
    stage_->device().finish();
}

void BrickVolume::refresh() {
    raycasting_.refresh(volume_, stage_->background().T_g_c(), slice_, prediction_);
    stage_->device().finish();
}

}  // namespace touchstone
