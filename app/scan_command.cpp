#include "app/scan_command.hpp"

#include <cstdio>
#include <fmt/format.h>

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

constexpr int least_default_frames = 60;  // what the running average of a fixed camera gains by

/// The fixed camera's model in the making.
class FixedScan {
  public:
    FixedScan(const Device& device, const InteractionConfig& config, const Intrinsics& intrinsics)
        : device_(&device),
          config_(with_shared_noise(config)),
          intrinsics_(intrinsics),
          conversion_(device, config_.conversion, intrinsics),
          live_(device, make_map_shape(intrinsics)) {}

    /// False while the camera sees nothing.
    bool add(const DepthFrame& frame) {
        const DepthView view{frame.depth_mm, frame.intrinsics};
        if (frame.width_px != intrinsics_.width_px || frame.height_px != intrinsics_.height_px)
            throw Error(ExitStatus::bad_data, "the pictures change their size during the scan: use one size");
        if (!background_) {
            const std::optional<VolumePlacement> placement = place_volume(view, config_.background);
            if (!placement) return false;
            background_.emplace(*device_, config_.background, intrinsics_, *placement);
        }
        conversion_.convert(view, live_);
        background_->scan(live_);
        device_->finish();
        last_seen_ = make_small_picture(view);
        return true;
    }

    SavedScan result() const {
        KeyframeDatabase keyframes;
        keyframes.add_if_new(last_seen_, background_->T_g_c());
        return {take_snapshot(background_->volume()),
                intrinsics_,
                background_->T_g_c(),
                {keyframes.keyframes().begin(), keyframes.keyframes().end()}};
    }

  private:
    const Device* device_;
    InteractionConfig config_;
    Intrinsics intrinsics_;
    DepthMapConversion conversion_;
    LiveMaps live_;
    std::optional<BackgroundModel> background_;
    SmallPicture last_seen_{};
};

void check_targets(const ScanOptions& options) {
    if (options.mesh_file) check_mesh_ending(*options.mesh_file);
    check_writable(options.scan_file);
    if (options.mesh_file) check_writable(*options.mesh_file);
}

struct ScanResult {
    SavedScan scan;
    int frames = 0;
};

ScanResult scan_surroundings(const ScanOptions& options, TerminationSignals& signals) {
    const Device device(device_config(options.config));
    run_self_test(device);
    DepthCamera camera = configured_camera(options.config, options.pace, false);
    log_info("reading {}, computing on {}", camera.name(), device.name());
    FixedScan scan(device, interaction_config(options.config, camera.model()), camera.intrinsics());
    const int wanted =
        options.frames.value_or(std::max(options.config.interaction.scan_frames, least_default_frames));
    int fused = 0;
    ProgressLine progress;
    for (int read = 0; read < wanted; ++read) {
        const std::optional<DepthFrame> frame = read_frame(camera, signals);
        if (!frame) break;
        fused += scan.add(*frame) ? 1 : 0;
        progress.show(fmt::format("scanning: {} of {} frames", read + 1, wanted));
    }
    if (signals.arrived())
        throw Error(ExitStatus::unavailable,
                    "ended by a signal before the scan was done; nothing is written");
    if (fused == 0)
        throw Error(ExitStatus::bad_data,
                    camera.name() + " shows nothing between 0.3 and 6 m: turn it to the surroundings");
    if (fused < wanted) log_warning("{} of {} frames showed something", fused, wanted);
    return {scan.result(), fused};
}

}  // namespace

ExitStatus scan_command(const ScanOptions& options) {
    set_log_level(log_level(options.config));
    check_targets(options);
    TerminationSignals signals;
    const ScanResult result = scan_surroundings(options, signals);
    const VolumeSnapshot& volume = result.scan.volume;
    save_scan(options.scan_file, result.scan);
    std::string summary =
        fmt::format("{} frames, {:.1f} million voxels of {:.1f} mm, {:.1f} MB; {}: {:.1f} MB", result.frames,
                    static_cast<double>(volume.voxels.size()) * 1e-6,
                    1000.0f * volume.config.side_m / static_cast<float>(volume.config.size_vox),
                    static_cast<double>(volume.voxels.size()) * 4e-6, options.scan_file,
                    static_cast<double>(std::filesystem::file_size(options.scan_file)) / 1e6);
    if (options.mesh_file) {
        const SurfaceMesh mesh = extract_surface(volume);
        write_mesh(*options.mesh_file, mesh);
        summary += fmt::format("; {}: {} triangles", *options.mesh_file, mesh.triangles.size());
    }
    std::printf("%s\n", summary.c_str());
    if (signals.arrived()) log_info("the signal to end came when the scan was done");
    return ExitStatus::ok;
}

}  // namespace touchstone
