#include "app/track_command.hpp"

#include <cstdio>
#include <fmt/format.h>
#include <fstream>

#include "app/configured_camera.hpp"
#include "app/frame_reading.hpp"
#include "app/progress_line.hpp"
#include "pipeline/mesh_file.hpp"
#include "pipeline/scan_file.hpp"
#include "pipeline/self_test.hpp"
#include "pipeline/surface_mesh.hpp"
#include "platform/system/atomic_file.hpp"
#include "platform/system/log.hpp"

namespace touchstone {

namespace {

constexpr std::size_t least_piece_divisor = 10;  // of an object's triangles, for a piece to be part of it

/// Lines "timestamp tx ty tz qx qy qz qw" (TUM RGB-D), each on the disk's way as soon as it is known.
class TrajectoryFile {
  public:
    explicit TrajectoryFile(const std::string& path) : path_(path), file_(path, std::ios::trunc) { check(); }

    void add(std::uint64_t timestamp_us, const RigidTransform& T_g_c) {
        const Eigen::Quaternionf q(T_g_c.linear());
        const Eigen::Vector3f t = T_g_c.translation();
        file_ << fmt::format("{:.6f} {:.6f} {:.6f} {:.6f} {:.7f} {:.7f} {:.7f} {:.7f}\n",
                             static_cast<double>(timestamp_us) * 1e-6, t.x(), t.y(), t.z(), q.x(), q.y(),
                             q.z(), q.w())
              << std::flush;
        check();
    }

  private:
    void check() const {
        if (!file_) throw Error(ExitStatus::io_error, "cannot write the trajectory to " + path_);
    }

    std::string path_;
    std::ofstream file_;
};

/// What became of the frames.
struct TrackingTally {
    int frames = 0, tracked = 0, fused = 0, lost = 0;
    TrackingState state = TrackingState::good;

    /// Counts one, and says when the state changes.
    void add(const DepthFrame& frame, const ReconstructionFrame& result) {
        const TrackingResult& tracking = result.tracking;
        ++frames;
        tracked += tracking.state == TrackingState::lost ? 0 : 1;
        lost += tracking.state == TrackingState::lost ? 1 : 0;
        fused += result.fused ? 1 : 0;
        if (tracking.state == state) return;
        state = tracking.state;
        if (state == TrackingState::lost)
            log_warning("frame {}: lost: {}; hold the camera where it was", frame.index, tracking.reason);
        else if (state == TrackingState::poor)
            log_info("frame {}: followed, not fused: {}", frame.index, tracking.reason);
        else
            log_info("frame {}: tracking again", frame.index);
    }
};

void check_targets(const TrackOptions& options) {
    if (options.mesh_file) check_mesh_ending(*options.mesh_file);
    for (const auto& file : {options.mesh_file, options.scan_file, options.trajectory_file})
        if (file) check_writable(*file);
}

/// Tracks frame after frame to the end of the source, the wanted number, or a signal.
class TrackSession {
  public:
    TrackSession(const TrackOptions& options, TerminationSignals& signals)
        : options_(options), signals_(&signals), device_(device_config(options.config)) {
        run_self_test(device_);
        camera_.emplace(configured_camera(options.config, options.pace, true));
        if (options.trajectory_file) trajectory_.emplace(*options.trajectory_file);
        log_info("reading {}, computing on {}", camera_->name(), device_.name());
    }

    void run() {
        ProgressLine progress;
        while (!options_.frames || tally_.frames < *options_.frames) {
            const std::optional<DepthFrame> frame = read_frame(*camera_, *signals_);
            if (!frame) break;
            process(*frame);
            const char* const state = tally_.state == TrackingState::lost ? "lost" : "tracking";
            const double megabytes =
                reconstruction_ ? static_cast<double>(reconstruction_->volume().memory_bytes()) / 1e6 : 0.0;
            progress.show(fmt::format("{}: {} frames, {} lost, {:.0f} MB", state, tally_.frames, tally_.lost,
                                      megabytes));
        }
    }

    const TrackingTally& tally() const { return tally_; }
    const std::optional<Reconstruction>& reconstruction() const { return reconstruction_; }
    const Intrinsics& intrinsics() const { return camera_->intrinsics(); }

  private:
    void process(const DepthFrame& frame) {
        const DepthView view{frame.depth_mm, frame.intrinsics};
        if (!reconstruction_)
            reconstruction_ =
                begin_reconstruction(device_, interaction_config(options_.config, camera_->model()), view,
                                     options_.voxels, options_.side_m);
        if (!reconstruction_) return;
        const ReconstructionFrame result = reconstruction_->process(view, frame.color_rgb);
        tally_.add(frame, result);
        if (result.moving_share > 0.0f)
            log_debug("frame {}: {:.2f} % of the view moves by itself", frame.index,
                      100.0f * result.moving_share);
        if (trajectory_ && result.tracking.state != TrackingState::lost)
            trajectory_->add(frame.timestamp_us, result.T_g_c);
    }

    TrackOptions options_;
    TerminationSignals* signals_;
    Device device_;
    std::optional<DepthCamera> camera_;
    std::optional<TrajectoryFile> trajectory_;
    std::optional<Reconstruction> reconstruction_;
    TrackingTally tally_;
};

void write_results(const TrackOptions& options, const TrackSession& session) {
    const Reconstruction& reconstruction = *session.reconstruction();
    const VolumeSnapshot volume = take_snapshot(reconstruction.volume());
    if (options.scan_file) {
        const auto keyframes = reconstruction.keyframes().keyframes();
        save_scan(
            *options.scan_file,
            {volume, session.intrinsics(), reconstruction.T_g_c(), {keyframes.begin(), keyframes.end()}});
    }
    std::string summary = fmt::format(
        "{} frames: {} fused, {} lost; {:.1f} million voxels of {:.1f} mm, {:.1f} MB", session.tally().frames,
        session.tally().fused, session.tally().lost, static_cast<double>(volume.voxels.size()) * 1e-6,
        1000.0f * options.side_m / static_cast<float>(options.voxels),
        static_cast<double>(reconstruction.volume().memory_bytes()) / 1e6);
    if (options.mesh_file) {
        SurfaceMesh mesh = extract_surface(volume);
        // An object is one piece: what hands left in the air beside it is not of it.
        if (options.side_m < object_side_m)
            remove_small_pieces(mesh, static_cast<int>(mesh.triangles.size() / least_piece_divisor));
        write_mesh(*options.mesh_file, mesh);
        summary += fmt::format("; {}: {} triangles", *options.mesh_file, mesh.triangles.size());
    }
    std::printf("%s\n", summary.c_str());
    for (const StageSummary& stage : reconstruction.stage_times().summary())
        log_debug("{}: median {:.2f} ms, 99 % {:.2f} ms", stage.stage, stage.median_ms, stage.p99_ms);
}

}  // namespace

std::optional<Reconstruction> begin_reconstruction(const Device& device, const InteractionConfig& interaction,
                                                   const DepthView& view, int voxels, float side_m) {
    const std::optional<RigidTransform> T_g_c = place_camera(view, side_m);
    if (!T_g_c) return std::nullopt;
    ReconstructionConfig config;
    config.noise = interaction.noise;
    config.conversion = interaction.conversion;
    config.volume = interaction.background.volume;
    config.volume.size_vox = voxels;
    config.volume.side_m = side_m;
    return std::make_optional<Reconstruction>(device, config, view.intrinsics, *T_g_c);
}

ExitStatus track_command(const TrackOptions& options) {
    set_log_level(log_level(options.config));
    check_targets(options);
    TerminationSignals signals;
    TrackSession session(options, signals);
    session.run();
    if (!session.reconstruction())
        throw Error(
            ExitStatus::bad_data,
            options.config.sensor_uri + " shows nothing between 0.3 and 6 m: turn the camera to the scene");
    write_results(options, session);
    return ExitStatus::ok;
}

}  // namespace touchstone
