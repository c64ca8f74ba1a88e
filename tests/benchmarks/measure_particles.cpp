// Time of a frame of particles against their number: measure_particles [--counts N...]. They lie three deep
// on the flat surface of a volume, two hands of still spheres among them.
#include <CLI/CLI.hpp>
#include <cmath>
#include <fmt/core.h>

#include "pipeline/particle_simulation.hpp"
#include "platform/system/stage_timer.hpp"
#include "tests/support/distance_snapshot.hpp"
#include "tests/support/program_main.hpp"

namespace touchstone {
namespace {

constexpr float frame_s = 1.0f / 30.0f;
constexpr int still_of_a_hand = 700;

/// A block three deep, a square on the surface at 10 cm.
std::vector<Particle> block(int count, float radius_m, float side_m) {
    const auto per_row = static_cast<int>(std::ceil(std::sqrt(static_cast<float>(count) / 3.0f)));
    const float step_m = 2.1f * radius_m;
    const float corner_m = 0.5f * (side_m - step_m * static_cast<float>(per_row));
    std::vector<Particle> particles;
    for (int i = 0; i < count; ++i) {
        const int layer = i / (per_row * per_row), in_layer = i % (per_row * per_row);
        particles.push_back({Eigen::Vector3f(corner_m + step_m * static_cast<float>(in_layer % per_row),
                                             corner_m + step_m * static_cast<float>(in_layer / per_row),
                                             0.1f + radius_m + step_m * static_cast<float>(layer))});
    }
    return particles;
}

std::vector<Particle> hands(float side_m) {
    std::vector<Particle> still;
    for (const float x_m : {0.45f * side_m, 0.55f * side_m})
        for (int i = 0; i < still_of_a_hand; ++i)
            still.push_back({Eigen::Vector3f(x_m + 0.007f * static_cast<float>(i % 14),
                                             0.5f * side_m + 0.007f * static_cast<float>(i / 14), 0.12f)});
    return still;
}

StageSummary measure(const Device& device, const TsdfVolume& volume, int count, int frames) {
    ParticleConfig config;
    config.capacity = count;
    // So many fit on the surface only when they are small.
    config.radius_m = std::min(0.005f, 0.4f * 1.5f / std::sqrt(static_cast<float>(count)));
    ParticleSimulation simulation(device, config);
    simulation.set_gravity({0.0f, 0.0f, -9.81f});
    simulation.add(block(count, config.radius_m, 1.5f));
    StageTimes times;
    for (int frame = 0; frame < frames; ++frame) {
        simulation.set_still(hands(1.5f));
        {
            const StageTimer timer(times, "particles");
            simulation.advance(frame_s, &volume);
            device.finish();
        }
        times.end_frame();
    }
    return times.summary("particles");
}

int run(int argc, char** argv) {
    CLI::App app("Time of a frame of particles against their number.");
    std::vector<int> counts{1024, 2048, 4096, 8192, 16384, 32768, 65536, 131072};
    int frames = 90;
    app.add_option("--counts", counts, "of particles");
    app.add_option("--frames", frames, "measured, of 1/30 s");
    CLI11_PARSE(app, argc, argv);
    const Device device(DeviceConfig{.choice = "auto", .cache_dir = default_cache_dir()});
    const VolumeConfig config{.size_vox = 128, .side_m = 1.5f};
    const TsdfVolume volume = restore_volume(
        device, test::snapshot_of(config, [](const Eigen::Vector3f& p) { return p.z() - 0.1f; }));
    fmt::print("{:>10} {:>10} {:>9} {:>16}\n", "particles", "median ms", "99 % ms", "us a particle");
    for (const int count : counts) {
        const StageSummary summary = measure(device, volume, count, frames);
        fmt::print("{:>10} {:>10.2f} {:>9.2f} {:>16.2f}\n", count, summary.median_ms, summary.p99_ms,
                   1e3 * summary.median_ms / count);
    }
    return 0;
}

}  // namespace
}  // namespace touchstone

int main(int argc, char** argv) {
    return touchstone::test::run_main("measure_particles", touchstone::run, argc, argv);
}
