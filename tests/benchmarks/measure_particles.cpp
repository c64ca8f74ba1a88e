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

/// Two hands that wander over the surface at up to 0.4 m/s, through all that lies there, and down to it.
std::vector<Particle> wandering_hands(float time_s) {
    std::vector<Particle> still;
    for (const float phase : {0.0f, 2.1f}) {
        const Eigen::Vector3f at_m(0.75f + 0.25f * std::sin(0.9f * time_s + phase),
                                   0.75f + 0.25f * std::sin(1.3f * time_s + 2.0f * phase),
                                   0.14f + 0.035f * std::sin(0.7f * time_s + phase));
        for (int i = 0; i < still_of_a_hand; ++i)
            still.push_back({at_m + 0.007f * Eigen::Vector3f(static_cast<float>(i % 14),
                                                             static_cast<float>(i / 14), 0.0f)});
    }
    return still;
}

/// Prints how many have passed the surface, and the fastest at the end, after hands have stirred them.
void endure(const Device& device, const TsdfVolume& volume, int count, float minutes) {
    ParticleConfig config;
    config.capacity = count;
    config.low_m = Eigen::Vector3f(0.1f, 0.1f, -1.0f);
    config.high_m = Eigen::Vector3f(1.4f, 1.4f, 1.4f);
    ParticleSimulation simulation(device, config);
    simulation.set_gravity({0.0f, 0.0f, -9.81f});
    simulation.add(block(count, config.radius_m, 1.5f));
    const int frames = static_cast<int>(60.0f * minutes / frame_s);
    float deepest_m = 0.0f;
    for (int frame = 0; frame < frames; ++frame) {
        simulation.set_still(wandering_hands(frame_s * static_cast<float>(frame)));
        simulation.advance(frame_s, &volume);
        if (frame % 30 != 29) continue;
        for (const Particle& p : simulation.particles())
            deepest_m = std::max(deepest_m, 0.1f - p.position_m.z());
    }
    simulation.set_still({});
    for (int frame = 0; frame < 150; ++frame) simulation.advance(frame_s, &volume);
    int passed = 0;
    float fastest = 0.0f;
    for (const Particle& p : simulation.particles()) {
        passed += p.position_m.z() < 0.1f - config.radius_m ? 1 : 0;
        fastest = std::max(fastest, p.velocity.norm());
    }
    fmt::print(
        "{} particles, {} minutes: {} have passed the surface, the deepest middle was {:.1f} mm in it; five "
        "seconds after the hands the fastest moves at {:.3f} m/s\n",
        simulation.count(), minutes, passed, 1e3f * deepest_m, fastest);
}

int run(int argc, char** argv) {
    CLI::App app("Time of a frame of particles against their number.");
    std::vector<int> counts{1024, 2048, 4096, 8192, 16384, 32768, 65536, 131072};
    int frames = 90;
    app.add_option("--counts", counts, "of particles");
    app.add_option("--frames", frames, "measured, of 1/30 s");
    float minutes = 0.0f;
    app.add_option("--endure", minutes, "instead: so many minutes of the first count, stirred by hands");
    CLI11_PARSE(app, argc, argv);
    const Device device(DeviceConfig{.choice = "auto", .cache_dir = default_cache_dir()});
    const VolumeConfig config{.size_vox = 128, .side_m = 1.5f};
    const TsdfVolume volume = restore_volume(
        device, test::snapshot_of(config, [](const Eigen::Vector3f& p) { return p.z() - 0.1f; }));
    if (minutes > 0.0f) {
        endure(device, volume, counts.front(), minutes);
        return 0;
    }
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
