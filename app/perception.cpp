#include "app/perception.hpp"

#include <algorithm>
#include <filesystem>
#include <thread>
#include <utility>

#include "app/reports.hpp"
#include "app/table_frames.hpp"
#include "app/touch_bias_file.hpp"
#include "pipeline/self_test.hpp"
#include "platform/system/atomic_file.hpp"
#include "platform/system/log.hpp"
#include "platform/usb/depth_cameras.hpp"

namespace touchstone {

namespace {

constexpr int read_timeout_ms = 100;
constexpr std::chrono::milliseconds retry_interval{500};

/// What is wrong with the camera that is plugged in, for the operator; empty where none is.
std::string problem_on_usb() {
    try {
        for (const UsbDepthCamera& camera : find_depth_cameras(list_usb_devices()))
            if (const std::string problem = problem_of(camera); !problem.empty()) return problem;
    } catch (const Error&) {
        // Without a view of USB there is nothing more to say.
    }
    return {};
}

bool same_camera(const Intrinsics& a, const Intrinsics& b) {
    return a.width_px == b.width_px && a.height_px == b.height_px && a.fx_px == b.fx_px &&
           a.fy_px == b.fy_px && a.cx_px == b.cx_px && a.cy_px == b.cy_px;
}

}  // namespace

Perception::Perception(const RunOptions& options)
    : options_(options),
      device_(device_config(options.config)),
      health_(options.config.health),
      areas_(options),
      outputs_(options, areas_.areas()),
      projector_(options.config.projector) {
    if (options.maps_dir) maps_.emplace(*options.maps_dir);
    if (!options.config.fault_reports.dir.empty()) fault_reports_.emplace(options.config.fault_reports);
    run_self_test(device_);
    log_info("computing on {}", device_.name());
    prepare_touch_bias();
    load_object();
    if (!options_.config.sensor_uri.empty()) open_camera();
}

Perception::~Perception() {
    if (!pipeline_) return;
    for (const StageTimes* times : {&pipeline_->stage_times(), &std::as_const(scene_times_)}) {
        for (const StageSummary& stage : times->summary())
            log_debug("{}: median {:.2f} ms, 99 % {:.2f} ms", stage.stage, stage.median_ms, stage.p99_ms);
    }
}

std::optional<TableFrame> Perception::step() {
    follow();
    std::optional<TableFrame> result = next();
    end_recording_when_due();
    if (result) result->operating = operator_view();
    const std::string state = result ? result->state : std::string("ended");
    if (camera_ && camera_->is_device()) health_.lost_packets(camera_->lost_packets());
    health_.tick(std::chrono::steady_clock::now(), state, static_cast<double>(rate_hz_),
                 pipeline_ ? &pipeline_->stage_times() : nullptr);
    return result;
}

std::optional<TableFrame> Perception::next() {
    if (options_.frames && frames_done_ >= *options_.frames) return std::nullopt;
    if (!camera_) return wait_for_camera();
    watch_projector();
    ReadResult result = camera_->read(read_timeout_ms);
    if (std::holds_alternative<StreamEnd>(result)) return std::nullopt;
    if (auto* frame = std::get_if<DepthFrame>(&result)) {
        const std::optional<CameraFault> fault = fault_of(*frame);
        if (fault_reports_) fault_reports_->keep(*frame);
        return fault ? without_good_frame(*fault) : process(*frame);
    }
    if (const auto* lost = std::get_if<CameraLost>(&result)) {
        if (!camera_->can_return()) throw Error(ExitStatus::unavailable, lost->reason);
        return without_camera(lost->reason);
    }
    return without_good_frame(silent_camera);
}

std::optional<TableFrame> Perception::wait_for_camera() {
    if (!recovery_.may_open(std::chrono::steady_clock::now())) {
        outputs_.idle();
        std::this_thread::sleep_for(std::chrono::milliseconds(read_timeout_ms));
        return last_shown_;
    }
    try {
        open_camera();
    } catch (const Error& error) {
        if (error.status() != ExitStatus::unavailable) throw;
        const std::string problem = problem_on_usb();
        const std::string note = problem.empty() ? "Waiting for a depth camera to be plugged in" : problem;
        if (last_shown_.note != note) {
            log_warning("{}", problem.empty()
                                  ? std::string(error.what()) + "; waiting for one to be plugged in"
                                  : problem);
        }
        outputs_.idle();
        std::this_thread::sleep_for(retry_interval);
        const std::string state = pipeline_ ? "sensor_lost" : "starting";
        return without_frame(state, note);
    }
    return without_frame(pipeline_ ? "sensor_lost" : "starting", "");
}

TableFrame Perception::without_frame(const std::string& state, const std::string& note) {
    last_shown_.state = state;
    last_shown_.note = note;
    last_shown_.touches.clear();
    last_shown_.hovers.clear();
    return last_shown_;
}

TableFrame Perception::process(const DepthFrame& frame) {
    const auto start = std::chrono::steady_clock::now();
    if (!pipeline_ || !same_camera(intrinsics_, frame.intrinsics)) {
        start_pipeline(frame.intrinsics);
    }
    InteractionFrame result = pipeline_->see({frame.depth_mm, frame.intrinsics}, frame.timestamp_us);
    areas_.assign(*pipeline_, result);
    publish(result, frame);
    health_.frame(frame.timestamp_us, camera_->rate_hz(),
                  static_cast<int>(std::ranges::count(result.touches, TouchPhase::down, &TouchEvent::phase)));
    recovery_.healthy(std::chrono::steady_clock::now());
    const InteractionConfig& config = options_.config.interaction;
    TableFrame shown =
        make_table_frame(*pipeline_, result, frame, config.scan_frames, shows_camera(config.rendering));
    shown.arrived = start;
    shown.areas = areas_.shown(*pipeline_, frame.intrinsics);
    show_light(shown.state);
    serve_scene(result, frame.timestamp_us, shown);
    follow_projector(result, frame, shown);
    desk_.see(frame, *pipeline_);
    if (asks_for_crosses(result.state)) take_crosses(result);
    if (asks_for_crosses(result.state)) shown.cross = crosses_->guide(*pipeline_->area(), intrinsics_);
    measure_rate(start);
    shown.frame_rate_hz = rate_hz_;
    shown.frame_ms = static_cast<float>(pipeline_->stage_times().summary("frame").median_ms);
    ++frames_done_;
    last_shown_ = shown;
    last_shown_.touches.clear();
    last_shown_.thrown = nullptr;
    to_follow_ = result.state;
    // What a projector shows is no colour of the surface while it is looked at.
    color_to_follow_ =
        shown.thrown || !wants_color(options_.config) ? std::vector<std::uint8_t>() : frame.color_rgb;
    return shown;
}

void Perception::follow() {
    if (!to_follow_) return;
    pipeline_->follow(color_to_follow_);
    save_scan_when_new(*std::exchange(to_follow_, std::nullopt));
}

void Perception::start_pipeline(const Intrinsics& intrinsics) {
    intrinsics_ = intrinsics;
    pipeline_ = std::make_unique<InteractionPipeline>(
        device_, interaction_config(options_.config, camera_->model()), intrinsics_);
    pipeline_->set_touch_bias(bias_);
    if (object_) pipeline_->follow_object(*object_);
    particles_.reset();
    scene_view_.reset();
    const std::string& file = options_.config.scan_file;
    if (file.empty() || std::exchange(ignores_saved_scan_, false)) return;
    std::error_code none;
    if (!std::filesystem::exists(file, none)) {
        log_info("no scan at {} yet: scanning", file);
        return;
    }
    try {
        const SavedScan scan = load_scan(file);
        pipeline_->use_scan(scan);
        areas_.use_scan(scan.T_g_c);
        log_info("comparing the scan {} with the view", file);
    } catch (const Error& error) {
        log_warning("{}; scanning anew", error.what());
    }
}

void Perception::load_object() {
    const std::string& file = options_.config.object_file;
    if (file.empty()) return;
    try {
        object_ = load_scan(file).volume;
    } catch (const Error& error) {
        if (error.status() != ExitStatus::bad_data) throw;
        log_warning("{}; the object is not followed", error.what());
        note_fault("object", error.what());
    }
}

void Perception::prepare_touch_bias() {
    const std::string& file = options_.config.bias_file;
    if (file.empty()) return;
    std::error_code none;
    if (std::filesystem::exists(file, none)) {
        try {
            bias_ = load_touch_bias(file);
            return;
        } catch (const Error& error) {
            log_warning("{}; the crosses are to be touched anew", error.what());
        }
    }
    keep("touch bias", "what the crosses tell is lost at the end", [&file] { check_writable(file); });
    crosses_.emplace(CrossStepConfig{});
}

void Perception::take_crosses(const InteractionFrame& result) {
    crosses_->take(result.touches, *pipeline_->area());
    const auto& fit = crosses_->result();
    if (!fit) return;
    if (fit->verdict != BiasVerdict::good) {
        log_warning("the crosses told nothing: {}; asking again", describe(*fit));
        crosses_.emplace(CrossStepConfig{}, "Once more: " + describe(*fit) + ".");
        return;
    }
    log_info("the crosses told the bias of touches: {}", describe(*fit));
    bias_ = fit->bias;
    pipeline_->set_touch_bias(bias_);
    if (options_.config.bias_file.empty())
        log_info("it is kept until the end: no [touch] bias_file is named");
    else
        keep("touch bias", "the next start asks for the crosses again",
             [&] { save_touch_bias(options_.config.bias_file, *fit); });
    crosses_.reset();
}

void Perception::publish(const InteractionFrame& result, const DepthFrame& frame) {
    TouchReport report = make_report(result, frame.index, frame.timestamp_us, areas_.areas());
    if (calibrates(result.state)) {
        report.touches.clear();
        report.hovers.clear();
    }
    outputs_.publish(report);
    if (!maps_) return;
    maps_->write_map(frame.index, "foreground", frame.width_px, frame.height_px, pipeline_->foreground_map());
    maps_->write_map(frame.index, "touch", frame.width_px, frame.height_px, pipeline_->touch_map());
}

void Perception::measure_rate(std::chrono::steady_clock::time_point start) {
    const std::chrono::duration<float> interval = start - last_frame_;
    if (frames_done_ > 0 && interval.count() > 0.0f) {
        rate_hz_ = rate_hz_ == 0.0f ? 1.0f / interval.count() : 0.9f * rate_hz_ + 0.1f / interval.count();
    }
    last_frame_ = start;
}

TableFrame merge_frames(TableFrame&& untaken, TableFrame&& newer) {
    untaken.touches.insert(untaken.touches.end(), newer.touches.begin(), newer.touches.end());
    newer.touches = std::move(untaken.touches);
    return std::move(newer);
}

}  // namespace touchstone
