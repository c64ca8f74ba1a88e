#include "tests/benchmarks/particle_bench.hpp"

#include <algorithm>
#include <cmath>

#include "tests/support/distance_snapshot.hpp"

namespace touchstone {

namespace {

constexpr float side_m = 1.5f;
constexpr int still_of_a_hand = 700;

/// So many fit on the surface only when they are small.
ParticleConfig bench_config(int count) {
    ParticleConfig config;
    config.capacity = count;
    config.radius_m = std::min(0.005f, 0.4f * side_m / std::sqrt(static_cast<float>(count)));
    return config;
}

}  // namespace

TsdfVolume particle_table_volume(const Device& device) {
    const VolumeConfig config{.size_vox = 128, .side_m = side_m};
    return restore_volume(
        device, test::snapshot_of(config, [](const Eigen::Vector3f& p) { return p.z() - particle_table_m; }));
}

std::vector<Particle> particle_block(int count, float radius_m) {
    const auto per_row = static_cast<int>(std::ceil(std::sqrt(static_cast<float>(count) / 3.0f)));
    const float step_m = 2.1f * radius_m;
    const float corner_m = 0.5f * (side_m - step_m * static_cast<float>(per_row));
    std::vector<Particle> particles;
    for (int i = 0; i < count; ++i) {
        const int layer = i / (per_row * per_row), in_layer = i % (per_row * per_row);
        particles.push_back(
            {Eigen::Vector3f(corner_m + step_m * static_cast<float>(in_layer % per_row),
                             corner_m + step_m * static_cast<float>(in_layer / per_row),
                             particle_table_m + radius_m + step_m * static_cast<float>(layer))});
    }
    return particles;
}

std::vector<Particle> hands_at(const Eigen::Vector3f& one_m, const Eigen::Vector3f& other_m) {
    std::vector<Particle> still;
    for (const Eigen::Vector3f& corner_m : {one_m, other_m})
        for (int i = 0; i < still_of_a_hand; ++i)
            still.push_back({corner_m + 0.007f * Eigen::Vector3f(static_cast<float>(i % 14),
                                                                 static_cast<float>(i / 14), 0.0f)});
    return still;
}

ParticleBench::ParticleBench(const Device& device, int count)
    : device_(&device), volume_(particle_table_volume(device)), simulation_(device, bench_config(count)) {
    simulation_.set_gravity({0.0f, 0.0f, -9.81f});
    simulation_.add(particle_block(count, bench_config(count).radius_m));
}

void ParticleBench::next_frame() {
    simulation_.set_still(hands_at({0.675f, 0.75f, 0.12f}, {0.825f, 0.75f, 0.12f}));
    simulation_.advance(particle_frame_s, &volume_);
    device_->finish();
}

}  // namespace touchstone
