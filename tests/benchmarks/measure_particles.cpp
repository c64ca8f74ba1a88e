// Time of a frame of particles against their number: measure_particles [--counts N...] [--endure MINUTES].
#include <CLI/CLI.hpp>
#include <cmath>
#include <fmt/core.h>

#include "platform/system/stage_timer.hpp"
#include "tests/benchmarks/particle_bench.hpp"
#include "tests/support/program_main.hpp"

namespace touchstone {
namespace {

StageSummary measure(const Device& device, int count, int frames) {
    ParticleBench bench(device, count);
    StageTimes times;
    for (int frame = 0; frame < frames; ++frame) {
        {
            const StageTimer timer(times, "particles");
            bench.next_frame();
        }
        times.end_frame();
    }
    return times.summary("particles");
}

/// Hands that wander over the surface at up to 0.4 m/s, through all that lies there, and down to it.
std::vector<Particle> wandering_hands(float time_s) {
    const auto place_m = [&](float phase) {
        return Eigen::Vector3f(0.75f + 0.25f * std::sin(0.9f * time_s + phase),
                               0.75f + 0.25f * std::sin(1.3f * time_s + 2.0f * phase),
                               0.14f + 0.035f * std::sin(0.7f * time_s + phase));
    };
    return hands_at(place_m(0.0f), place_m(2.1f));
}

/// Prints how many have passed the surface, and the fastest at the end, after hands have stirred them.
void endure(const Device& device, int count, float minutes) {
    const TsdfVolume volume = particle_table_volume(device);
    ParticleConfig config;
    config.capacity = count;
    config.low_m = Eigen::Vector3f(0.1f, 0.1f, -1.0f);
    config.high_m = Eigen::Vector3f(1.4f, 1.4f, 1.4f);
    ParticleSimulation simulation(device, config);
    simulation.set_gravity({0.0f, 0.0f, -9.81f});
    simulation.add(particle_block(count, config.radius_m));
    const int frames = static_cast<int>(60.0f * minutes / particle_frame_s);
    float deepest_m = 0.0f;
    for (int frame = 0; frame < frames; ++frame) {
        simulation.set_still(wandering_hands(particle_frame_s * static_cast<float>(frame)));
        simulation.advance(particle_frame_s, &volume);
        if (frame % 30 != 29) continue;
        for (const Particle& p : simulation.particles())
            deepest_m = std::max(deepest_m, particle_table_m - p.position_m.z());
    }
    simulation.set_still({});
    for (int frame = 0; frame < 150; ++frame) simulation.advance(particle_frame_s, &volume);
    int passed = 0;
    float fastest = 0.0f;
    for (const Particle& p : simulation.particles()) {
        passed += p.position_m.z() < particle_table_m - config.radius_m ? 1 : 0;
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
    float minutes = 0.0f;
    app.add_option("--counts", counts, "of particles");
    app.add_option("--frames", frames, "measured, of 1/30 s");
    app.add_option("--endure", minutes, "instead: so many minutes of the first count, stirred by hands");
    CLI11_PARSE(app, argc, argv);
    const Device device(DeviceConfig{.choice = "auto", .cache_dir = default_cache_dir()});
    if (minutes > 0.0f) {
        endure(device, counts.front(), minutes);
        return 0;
    }
    fmt::print("{:>10} {:>10} {:>9} {:>16}\n", "particles", "median ms", "99 % ms", "us a particle");
    for (const int count : counts) {
        const StageSummary summary = measure(device, count, frames);
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
