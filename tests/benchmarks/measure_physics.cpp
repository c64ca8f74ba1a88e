// A camera that moves, the reconstruction of what it sees, and particles that fall onto it (Fig 7), all at
// once, beside the same reconstruction without: measure_physics SENSOR [--voxels N] [--side METRES]
// [--particles N] [--frames N].
#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/core.h>
#include <random>

#include "app/config.hpp"
#include "app/frame_reading.hpp"
#include "app/track_command.hpp"
#include "pipeline/particle_simulation.hpp"
#include "platform/system/stage_timer.hpp"
#include "tests/support/program_main.hpp"

namespace touchstone {
namespace {

constexpr float frame_s = 1.0f / 30.0f;
constexpr int rain_per_frame = 48;

struct Options {
    std::string sensor;
    int voxels = 256, particles = 4096, frames = 1'000'000;
    float side_m = 4.8f;
};

/// Drops through free space a little before the camera, all over the first half metre of its view.
std::vector<Particle> rain(const RigidTransform& T_g_c, std::mt19937& random) {
    std::uniform_real_distribution<float> across(-0.4f, 0.4f), ahead(0.5f, 1.5f);
    std::vector<Particle> drops;
    for (int i = 0; i < rain_per_frame; ++i) {
        const float z_m = ahead(random);
        drops.push_back({T_g_c * Eigen::Vector3f(across(random) * z_m, across(random) * z_m, z_m)});
    }
    return drops;
}

int count_resting(const std::vector<Particle>& particles) {
    return static_cast<int>(
        std::ranges::count_if(particles, [](const Particle& p) { return p.velocity.norm() < 0.05f; }));
}

void measure(const Options& options) {
    Config config;
    const Device device(device_config(config));
    TerminationSignals signals;
    DepthCamera camera = DepthCamera::open(options.sensor, Pace::step, true, camera_setup(config));
    ParticleConfig particle_config;
    particle_config.capacity = options.particles;
    ParticleSimulation particles(device, particle_config);
    std::optional<Reconstruction> alone, with_particles;
    StageTimes times;
    std::mt19937 random(1);
    float apart_mm = 0.0f;
    int frames = 0, lost = 0;
    for (; frames < options.frames; ++frames) {
        const std::optional<DepthFrame> frame = read_frame(camera, signals);
        if (!frame) break;
        const DepthView view{frame->depth_mm, frame->intrinsics};
        for (std::optional<Reconstruction>* each : {&alone, &with_particles})
            if (!*each)
                *each = begin_reconstruction(device, interaction_config(config, camera.model()), view,
                                             options.voxels, options.side_m);
        if (!alone) continue;
        // The first picture's down: the volume's axes are those of the first camera.
        particles.set_gravity({0.0f, 9.81f, 0.0f});
        const RigidTransform T_alone = alone->process(view, frame->color_rgb).T_g_c;
        {
            const StageTimer timer(times, "both");
            const ReconstructionFrame result = with_particles->process(view, frame->color_rgb);
            lost += result.tracking.state == TrackingState::lost ? 1 : 0;
            if (particles.count() < options.particles) particles.add(rain(result.T_g_c, random));
            const StageTimer physics(times, "particles");
            particles.advance(frame_s, &with_particles->volume());
            device.finish();
        }
        times.end_frame();
        apart_mm = std::max(apart_mm,
                            1000.0f * (T_alone.translation() - with_particles->T_g_c().translation()).norm());
    }
    const StageSummary both = times.summary("both"), physics = times.summary("particles");
    fmt::print(
        "{} frames, {} lost; tracking, fusion and particles {:.1f} ms (99 % {:.1f}), of which particles "
        "{:.1f} ms (99 % {:.1f}); {} particles, {} of them at rest; the camera's path differs by at most "
        "{:.3f} mm from the one without them\n",
        frames, lost, both.median_ms, both.p99_ms, physics.median_ms, physics.p99_ms, particles.count(),
        count_resting(particles.particles()), static_cast<double>(apart_mm));
}

int run(int argc, char** argv) {
    CLI::App app("Tracking, fusion and particles at once.");
    Options options;
    app.add_option("SENSOR", options.sensor, "as of touchstone track")->required();
    app.add_option("--voxels", options.voxels, "along a side of the volume");
    app.add_option("--side", options.side_m, "of the volume, metres");
    app.add_option("--particles", options.particles, "at most");
    app.add_option("--frames", options.frames, "at most");
    CLI11_PARSE(app, argc, argv);
    measure(options);
    return 0;
}

}  // namespace
}  // namespace touchstone

int main(int argc, char** argv) {
    return touchstone::test::run_main("measure_physics", touchstone::run, argc, argv);
}
