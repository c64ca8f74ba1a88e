#include "app/bench_command.hpp"

#include <cstdio>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/configured_camera.hpp"
#include "app/frame_reading.hpp"
#include "app/presentation.hpp"
#include "app/progress_line.hpp"
#include "app/table_frames.hpp"
#include "app/track_command.hpp"
#include "pipeline/interaction_pipeline.hpp"
#include "pipeline/reconstruction.hpp"
#include "pipeline/self_test.hpp"
#include "platform/system/atomic_file.hpp"
#include "platform/system/log.hpp"
#include "platform/system/process_memory.hpp"

namespace touchstone {

namespace {

constexpr std::string_view whole_frame = "frame", to_photon = "touch to photon";

RunOptions shown_as(const BenchOptions& options) {
    RunOptions run;
    run.config = options.config;
    run.display = options.display;
    return run;
}

/// Times of one frame after the other; what is not live is not counted.
class Bench {
  public:
    Bench(const BenchOptions& options, TerminationSignals& signals)
        : options_(options), signals_(&signals), device_(device_config(options.config)) {
        run_self_test(device_);
        camera_.emplace(
            configured_camera(options.config, options.pace, options.moving || wants_color(options.config)));
        log_info("reading {}, computing on {}", camera_->name(), device_.name());
        if (options.display) presentation_.emplace(shown_as(options));
    }

    BenchResult run() {
        ProgressLine progress;
        while (live_frames_ < options_.frames) {
            const std::optional<DepthFrame> frame = read_frame(*camera_, *signals_);
            if (!frame) break;
            live_frames_ += options_.moving ? track(*frame) : interact(*frame);
            progress.show(fmt::format("measuring: {} of {} frames", live_frames_, options_.frames));
        }
        if (signals_->arrived())
            throw Error(ExitStatus::unavailable, "ended by a signal before the measurement was done");
        if (live_frames_ == 0)
            throw Error(ExitStatus::bad_data,
                        camera_->name() + " ends before anything is live: the scan takes " +
                            std::to_string(options_.config.interaction.scan_frames) + " frames");
        return result();
    }

  private:
    /// Whether the frame is measured: the first live one is not, with what runs for the first time in it.
    bool interact(const DepthFrame& frame) {
        const auto arrived = std::chrono::steady_clock::now();
        if (!pipeline_)
            pipeline_.emplace(device_, interaction_config(options_.config, camera_->model()),
                              frame.intrinsics);
        const InteractionFrame seen = pipeline_->see({frame.depth_mm, frame.intrinsics}, frame.timestamp_us);
        if (presentation_) show(seen, frame, arrived);
        pipeline_->follow(frame.color_rgb);
        if (is_live_) return true;
        is_live_ = seen.state == InteractionState::live;
        pipeline_->forget_stage_times();
        photon_times_.clear();
        return false;
    }

    void show(const InteractionFrame& seen, const DepthFrame& frame,
              std::chrono::steady_clock::time_point arrived) {
        const InteractionConfig& config = options_.config.interaction;
        TableFrame shown =
            make_table_frame(*pipeline_, seen, frame, config.scan_frames, shows_camera(config.rendering));
        shown.arrived = arrived;
        (void)presentation_->should_close();
        presentation_->draw(shown);
        presentation_->show();
        presentation_->finish();
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - arrived;
        photon_times_.add(to_photon, taken.count());
        photon_times_.end_frame();
    }

    bool track(const DepthFrame& frame) {
        const DepthView view{frame.depth_mm, frame.intrinsics};
        if (!reconstruction_)
            reconstruction_ =
                begin_reconstruction(device_, interaction_config(options_.config, camera_->model()), view,
                                     options_.voxels, options_.side_m);
        if (!reconstruction_) return false;
        reconstruction_->process(view, frame.color_rgb);
        return true;
    }

    BenchResult result() const {
        const StageTimes& times = pipeline_ ? pipeline_->stage_times() : reconstruction_->stage_times();
        const TsdfVolume& volume = pipeline_ ? pipeline_->background()->volume() : reconstruction_->volume();
        BenchResult result{device_.name(),
                           times.summary(whole_frame),
                           {},
                           peak_rss_mb(),
                           static_cast<double>(volume.memory_bytes()) / 1e6};
        for (const StageSummary& stage : times.summary())
            if (stage.stage != whole_frame) result.stages.push_back(stage);
        if (presentation_) result.touch_to_photon = photon_times_.summary(to_photon);
        return result;
    }

    BenchOptions options_;
    TerminationSignals* signals_;
    Device device_;
    std::optional<DepthCamera> camera_;
    std::optional<InteractionPipeline> pipeline_;
    std::optional<Reconstruction> reconstruction_;
    std::optional<Presentation> presentation_;  ///< where its pictures are measured
    StageTimes photon_times_;
    bool is_live_ = false;
    int live_frames_ = 0;
};

}  // namespace

std::string bench_json(const BenchResult& result) {
    nlohmann::ordered_json json;
    json["device"] = result.device;
    json["frames"] = result.frame.frames;
    json["frame_ms"] = {{"median", result.frame.median_ms}, {"p99", result.frame.p99_ms}};
    json["stages"] = nlohmann::ordered_json::object();
    for (const StageSummary& stage : result.stages)
        json["stages"][stage.stage] = {{"median_ms", stage.median_ms}, {"p99_ms", stage.p99_ms}};
    json["peak_rss_mb"] = result.peak_rss_mb;
    json["volume_mb"] = result.volume_mb;
    if (const auto& photon = result.touch_to_photon)
        json["touch_to_photon_ms"] = {{"median", photon->median_ms}, {"p99", photon->p99_ms}};
    return json.dump(2) + "\n";
}

std::string bench_table(const BenchResult& result) {
    std::string table = fmt::format("{}\n{:<34}{:>10}{:>10}\n", result.device, "", "median ms", "99 % ms");
    for (const StageSummary& stage : result.stages)
        table += fmt::format("{:<34}{:>10.2f}{:>10.2f}\n", stage.stage, stage.median_ms, stage.p99_ms);
    table += fmt::format("{:<34}{:>10.2f}{:>10.2f}\n", fmt::format("frame ({} of them)", result.frame.frames),
                         result.frame.median_ms, result.frame.p99_ms);
    if (const auto& photon = result.touch_to_photon)
        table += fmt::format("{:<34}{:>10.2f}{:>10.2f}\n", to_photon, photon->median_ms, photon->p99_ms);
    return table +
           fmt::format("memory: {:.0f} MB at most, volume {:.1f} MB\n", result.peak_rss_mb, result.volume_mb);
}

BenchResult measure_frames(const BenchOptions& options, TerminationSignals& signals) {
    return Bench(options, signals).run();
}

ExitStatus bench_command(const BenchOptions& options) {
    set_log_level(log_level(options.config));
    const bool to_file = options.json_file && *options.json_file != "-";
    if (to_file) check_writable(*options.json_file);
    TerminationSignals signals;
    const BenchResult result = measure_frames(options, signals);
    if (to_file) write_file_atomically(*options.json_file, bench_json(result));
    std::fputs((options.json_file && !to_file ? bench_json(result) : bench_table(result)).c_str(), stdout);
    return ExitStatus::ok;
}

}  // namespace touchstone
