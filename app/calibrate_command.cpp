#include "app/calibrate_command.hpp"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/displays.hpp"
#include "app/frame_reading.hpp"
#include "app/progress_line.hpp"
#include "app/projector_file.hpp"
#include "app/projector_mapping.hpp"
#include "pipeline/gray_code_session.hpp"
#include "pipeline/interaction_pipeline.hpp"
#include "pipeline/projector_crosses.hpp"
#include "pipeline/self_test.hpp"
#include "platform/system/atomic_file.hpp"
#include "platform/system/log.hpp"
#include "ui/calibration_screen.hpp"

namespace touchstone {
namespace {

constexpr int frames_of_model = 45;  // live, undisturbed: until its points are good to about a millimetre
constexpr int most_foreground_px = 300;
constexpr int cells_across = 160;
constexpr ProjectorFitConfig touch_fit{.sigma_px = 3.0f, .most_rms_px = 8.0f};

/// Of each pixel of the camera: x, y, z of the scan's frame, 1; 0 where there is none.
std::vector<Eigen::Vector4f> points_of(const BackgroundModel& background, const Intrinsics& intrinsics) {
    return make_surface_grid(background.prediction(), intrinsics, background.T_g_c(), 1).points_g_m;
}

/// What became of the stripes, where the fit alone does not tell.
std::string words_on_stripes(const CellPicture& cells, std::span<const Eigen::Vector4f> points_g_m,
                             const ProjectorFit& fit) {
    if (fit.verdict == ProjectorVerdict::good) return describe(fit);
    const auto pixels = static_cast<double>(cells.column.size());
    const double lit = 100.0 * cells.lit / pixels;
    if (lit < 1.0)
        return "the camera saw nothing of the projector: is it on, does it light what the camera sees, is "
               "the "
               "room too bright?";
    const double known =
        100.0 *
        static_cast<double>(std::ranges::count_if(cells.column, [](int column) { return column >= 0; })) /
        pixels;
    const double deep = 100.0 *
                        static_cast<double>(std::ranges::count_if(
                            points_g_m, [](const Eigen::Vector4f& point) { return point.w() > 0.0f; })) /
                        pixels;
    return fmt::format(
        "the projector lights {:.0f} % of the colour picture, its stripes were read in {:.0f} %, "
        "depth is known in {:.0f} %; {}",
        lit, known, deep, describe(fit));
}

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
        camera_.emplace(DepthCamera::open(options.config.sensor_uri, options.pace, by_light,
                                          camera_setup(options.config)));
        if (by_light && !camera_->has_color())
            throw Error(ExitStatus::unavailable,
                        camera_->name() + " has no colour picture to see the stripes in: use --method touch");
        log_info("reading {}, computing on {}", camera_->name(), device_.name());
    }

    CalibrationResult run() {
        scan();
        return options_.method == CalibrationMethod::graycode ? see_stripes() : ask_for_touches();
    }

    int frames() const { return frames_; }
    double rate_hz() const { return camera_->rate_hz(); }
    /// For a file: points of the camera's frame.
    ProjectorModel seen_from_camera(const ProjectorModel& model) const {
        return in_other_frame(model, pipeline_->background()->T_g_c().inverse(Eigen::Isometry));
    }

  private:
    std::unique_ptr<Display> open_projector() {
        if (!has_simulated_projector(options_.config.sensor_uri))
            return open_display(choose_display(options_.display), options_.config.display,
                                WindowPixels::shown_only);
        auto simulated = open_simulated_projector();
        simulated_ = simulated.get();
        return simulated;
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

    bool is_disturbed(const InteractionFrame& seen) const {
        if (seen.state != InteractionState::live) return true;
        return std::ranges::count(pipeline_->foreground_map(), std::uint8_t{255}) > most_foreground_px;
    }

    void scan() {
        screen_.show_words("");
        int quiet = 0, frames = 0;
        while (quiet < frames_of_model) {
            const InteractionFrame seen = see();
            const bool is_live = seen.state == InteractionState::live;
            const bool disturbed = is_live && is_disturbed(seen);
            quiet = !is_live || disturbed ? 0 : quiet + 1;
            if (disturbed) screen_.show_words("Keep away from the table for a moment");
            progress_.show(fmt::format("scanning the table: frame {}", ++frames));
        }
    }

    CalibrationResult see_stripes() {
        const PixelSize size = display_->size_px();
        const int cell_px = std::max(2, (size.width_px + cells_across - 1) / cells_across);
        GrayCodeSession session({size.width_px, size.height_px, cell_px});
        int shown = -1;
        bool warned = false;
        while (const auto pattern = session.pattern()) {
            if (*pattern != shown) screen_.show_pattern(draw_pattern(session.code(), *pattern));
            shown = *pattern;
            progress_.show(fmt::format("stripes: {} of {}", shown + 1, session.code().patterns()));
            const bool disturbed = is_disturbed(see());
            session.take(frame_->color_rgb, disturbed);
            if (disturbed && !warned)
                log_warning("something moves in the view: its patterns are shown again");
            warned = session.is_disturbed();
        }
        const Intrinsics& k = frame_->intrinsics;
        const CellPicture cells = session.cells(k.width_px, k.height_px);
        const auto points_g_m = points_of(*pipeline_->background(), k);
        const auto matches = match_cells(session.code(), cells, points_g_m);
        const ProjectorFit fit = fit_projector(matches, size.width_px, size.height_px, area_g(), {});
        return {"graycode", fit, words_on_stripes(cells, points_g_m, fit)};
    }

    CalibrationResult ask_for_touches() {
        const PixelSize size = display_->size_px();
        const Intrinsics& k = frame_->intrinsics;
        ProjectorCrosses crosses(size.width_px, size.height_px, area_g(),
                                 standing_out(points_of(*pipeline_->background(), k), k.width_px, area_g()));
        while (const auto cross = crosses.cross_px()) {
            if (simulated_) simulated_->set_aim(std::array{cross->x(), cross->y()});
            screen_.show_cross(
                *cross, fmt::format("{}  {} of {}", crosses.words(), crosses.shown() + 1, crosses.wanted()));
            const InteractionFrame seen = see();
            const std::size_t touched = crosses.matches().size();
            const int shown = crosses.shown();
            crosses.take(seen.touches, pipeline_->background()->T_g_c(), frame_->timestamp_us);
            if (crosses.shown() > shown)
                log_info("cross {} of {}: {}", crosses.shown(), crosses.wanted(),
                         crosses.matches().size() > touched ? "touched" : "passed over");
            progress_.show(fmt::format("crosses: {} of {}", crosses.shown(), crosses.wanted()));
        }
        const ProjectorFit fit =
            fit_projector(crosses.matches(), size.width_px, size.height_px, area_g(), touch_fit);
        return {"touch", fit, describe(fit)};
    }

    InteractiveArea area_g() const {
        return transformed(pipeline_->background()->T_g_c(), *pipeline_->area());
    }

    CalibrateOptions options_;
    TerminationSignals* signals_;
    Device device_;
    SimulatedProjector* simulated_ = nullptr;  // the display, where it is one
    std::unique_ptr<Display> display_;
    CalibrationScreen screen_;
    std::optional<DepthCamera> camera_;
    std::optional<InteractionPipeline> pipeline_;
    std::optional<DepthFrame> frame_;
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
    if (!file.empty()) check_writable(file);
    if (options.json_file && *options.json_file != "-") check_writable(*options.json_file);
    TerminationSignals signals;
    Calibration calibration(options, signals);
    const CalibrationResult result = calibration.run();
    log_info("calibrated in {} frames, {:.1f} s of the camera", calibration.frames(),
             calibration.frames() / calibration.rate_hz());
    if (options.json_file) write_json(*options.json_file, calibration_json(result));
    const bool is_good = result.fit.verdict == ProjectorVerdict::good;
    if (!is_good) throw Error(ExitStatus::bad_data, "not calibrated: " + result.verdict);
    if (options.json_file != "-") std::printf("%s\n", result.verdict.c_str());
    if (file.empty()) {
        log_warning("nothing is kept: name a file as projector.file in the configuration");
        return ExitStatus::ok;
    }
    save_projector(file, {calibration.seen_from_camera(result.fit.model), result.method, result.fit.rms_px,
                          result.fit.rms_mm, result.fit.used});
    log_info("kept in {}", file);
    return ExitStatus::ok;
}

}  // namespace touchstone
