#include "app/calibrate_command.hpp"

#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/configured_camera.hpp"
#include "app/displays.hpp"
#include "app/frame_reading.hpp"
#include "app/progress_line.hpp"
#include "app/projector_file.hpp"
#include "pipeline/interaction_pipeline.hpp"
#include "pipeline/self_test.hpp"
#include "platform/system/atomic_file.hpp"
#include "platform/system/log.hpp"
#include "ui/calibration_screen.hpp"

namespace touchstone {
namespace {

/// The program around a calibration: camera, pipeline and projector.
class Calibration {
  public:
    Calibration(const CalibrateOptions& options, TerminationSignals& signals)
        : options_(options),
          signals_(&signals),
          device_(device_config(options.config)),
          display_(open_projector()),
          screen_(*display_) {
        run_self_test(device_);
        const bool by_light = options.method == CalibrationMethod::graycode;
        camera_.emplace(configured_camera(options.config, options.pace, by_light));
        if (by_light && !camera_->has_color())
            throw Error(ExitStatus::unavailable,
                        camera_->name() + " has no colour picture to see the stripes in: use --method touch");
        log_info("reading {}, computing on {}", camera_->name(), device_.name());
    }

    CalibrationResult run() {
        ProjectorCalibration calibration(options_.method, display_->size_px());
        while (!calibration.result()) {
            show(calibration.picture());
            const InteractionFrame seen = see();
            calibration.take({seen, *pipeline_, *frame_});
            if (calibration.wants_held_exposure()) camera_->hold_exposure();
            progress_.show(calibration.progress());
        }
        camera_->release_exposure();
        return *calibration.result();
    }

    int frames() const { return frames_; }
    double rate_hz() const { return camera_->rate_hz(); }
    /// For a file: points of the camera's frame.
    ProjectorModel seen_from_camera(const ProjectorModel& model) const {
        return in_other_frame(model, pipeline_->background()->T_g_c().inverse(Eigen::Isometry));
    }

  private:
    std::unique_ptr<Display> open_projector() {
        if (has_simulated_projector(options_.config.sensor_uri)) return open_simulated_projector();
        return open_display(choose_display(options_.display), options_.config.display,
                            WindowPixels::shown_only);
    }

    /// The next frame and what it shows. Throws where there is none.
    InteractionFrame see() {
        frame_ = read_frame(*camera_, *signals_);
        if (signals_->arrived())
            throw Error(ExitStatus::unavailable, "ended by a signal before the calibration was done");
        if (display_->should_close())
            throw Error(ExitStatus::unavailable, "the window was closed before the calibration was done");
        if (!frame_)
            throw Error(ExitStatus::no_input, camera_->name() + " ends before the calibration was done");
        ++frames_;
        if (!pipeline_)
            pipeline_.emplace(device_, interaction_config(options_.config, camera_->model()),
                              frame_->intrinsics);
        return pipeline_->process({frame_->depth_mm, frame_->intrinsics}, frame_->timestamp_us);
    }

    void show(const std::shared_ptr<const ThrownPicture>& picture) {
        if (picture == shown_) return;
        shown_ = picture;
        show_to_simulated_hands(*display_, picture->cross_px);
        screen_.draw(*picture);
        display_->present();
    }

    CalibrateOptions options_;
    TerminationSignals* signals_;
    Device device_;
    std::unique_ptr<Display> display_;
    CalibrationScreen screen_;
    std::optional<DepthCamera> camera_;
    std::optional<InteractionPipeline> pipeline_;
    std::optional<DepthFrame> frame_;
    std::shared_ptr<const ThrownPicture> shown_;
    int frames_ = 0;  ///< that were looked at
    ProgressLine progress_;
};

void write_json(const std::string& file, const std::string& json) {
    if (file == "-")
        std::printf("%s\n", json.c_str());
    else
        write_file_atomically(file, json + "\n");
}

}  // namespace

std::string calibration_json(const CalibrationResult& result) {
    const auto rounded = [](float value) { return std::round(1000.0 * static_cast<double>(value)) / 1000.0; };
    nlohmann::ordered_json json;
    json["method"] = result.method;
    json["model"] = result.fit.model.kind == ProjectorModelKind::pinhole ? "pinhole" : "homography";
    json["rms_px"] = rounded(result.fit.rms_px);
    json["rms_mm"] = rounded(result.fit.rms_mm);
    json["points"] = result.fit.used;
    json["verdict"] = result.verdict;
    return json.dump();
}

ExitStatus calibrate_command(const CalibrateOptions& options) {
    set_log_level(log_level(options.config));
    const std::string& file = options.config.projector.file;
    if (file.empty())
        log_warning("nothing will be kept: name a file as [projector] file in the configuration");
    else
        check_writable(file);
    if (options.json_file && *options.json_file != "-") check_writable(*options.json_file);
    TerminationSignals signals;
    Calibration calibration(options, signals);
    const CalibrationResult result = calibration.run();
    log_info("looked at {} frames, {:.1f} s of the camera", calibration.frames(),
             calibration.frames() / calibration.rate_hz());
    if (options.json_file) write_json(*options.json_file, calibration_json(result));
    const bool is_good = result.fit.verdict == ProjectorVerdict::good;
    if (!is_good) throw Error(ExitStatus::bad_data, "not calibrated: " + result.verdict);
    if (options.json_file != "-") std::printf("%s\n", result.verdict.c_str());
    if (file.empty()) return ExitStatus::ok;
    save_projector(file, {calibration.seen_from_camera(result.fit.model), result.method, result.fit.rms_px,
                          result.fit.rms_mm, result.fit.used});
    log_info("kept in {}", file);
    return ExitStatus::ok;
}

}  // namespace touchstone
