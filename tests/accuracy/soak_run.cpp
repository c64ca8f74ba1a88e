#include "tests/accuracy/soak_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>

#include "platform/system/percentile.hpp"
#include "tests/support/watched_program.hpp"

namespace touchstone {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double sample_every_s = 5.0;
constexpr int fault_frames = 8;  // more frames than this are not dropped: the camera gave none
constexpr int beside_fault_frames = 45;
constexpr double lag_memory_s = 30.0;  // of the quickest frame, with which others are compared

/// Lags of frames: their lines' times of arrival less their own times, over the least of late.
class LagMeter {
  public:
    double take_ms(double arrived_s, double given_s) {
        const double behind_s = arrived_s - given_s;
        if (std::abs(behind_s - least_s_) > 10.0 || arrived_s - since_s_ > lag_memory_s) {
            least_s_ = std::min(next_least_s_, behind_s);  // the clock jumped, or it drifts
            next_least_s_ = std::numeric_limits<double>::max();
            since_s_ = arrived_s;
        }
        least_s_ = std::min(least_s_, behind_s);
        next_least_s_ = std::min(next_least_s_, behind_s);
        return 1000.0 * (behind_s - least_s_);
    }
    void forget() { least_s_ = next_least_s_ = std::numeric_limits<double>::max(); }

  private:
    double least_s_ = std::numeric_limits<double>::max(), next_least_s_ = least_s_, since_s_ = 0.0;
};

/// Takes the lines of the event log in.
class Soak {
  public:
    explicit Soak(const SoakRun& run)
        : run_(run), truth_(folder_ / "truth.json"), program_(command(run, truth_.string())) {}

    SoakScore score() {
        while (score_.seconds < 60.0 * run_.minutes) take(nlohmann::json::parse(program_.line()));
        score_.faults = test::faults_in(program_.log());
        score_.restarts = test::restarts_in(program_.log());
        score_.exit_status = program_.end();
        finish();
        return std::move(score_);
    }

  private:
    static std::vector<std::string> command(const SoakRun& run, const std::string& truth) {
        std::string sensor = fmt::format("sim:{}?hands=2&human=1&seed={}&pause={}&truth={}", run.scene,
                                         run.seed, run.pause_s, truth);
        if (run.faults_every_s > 0.0) sensor += fmt::format("&faults_every={}&fault_s=1", run.faults_every_s);
        std::vector<std::string> words{run.program, "run",       "--sensor", sensor,     "--pace",
                                       "live",      "--display", "headless", "--events", "-"};
        if (!run.config.empty()) words.insert(words.end(), {"--config", run.config});
        return words;
    }

    void take(const nlohmann::json& line) {
        const auto now = Clock::now();
        if (last_frame_ < 0 && line["state"] != "live") return;
        if (last_frame_ < 0) start_ = next_sample_ = now;
        const int frame = line["frame"];
        const double at_s = std::chrono::duration<double>(now - start_).count();
        const int missing = last_frame_ < 0 ? 0 : frame - last_frame_ - 1;
        if (missing > fault_frames || line["state"] != "live") {
            gaps_.emplace_back(last_frame_, frame);
            lag_.forget();
        } else {
            score_.dropped += std::max(missing, 0);
            ++score_.frames;
            whole_s_ += at_s - score_.seconds;
            const double lag_ms = lag_.take_ms(at_s, 1e-6 * line["time_us"].get<double>());
            lags_ms_.push_back(static_cast<float>(lag_ms));
            next_.worst_lag_ms = std::max(next_.worst_lag_ms, lag_ms);
        }
        ++next_.frames;
        last_frame_ = frame;
        score_.seconds = at_s;
        note_touches(line, frame);
        if (now >= next_sample_) sample(at_s);
    }

    void note_touches(const nlohmann::json& line, int frame) {
        std::vector<LoggedTouch> touches;
        for (const auto& touch : line["touches"])
            if (touch["phase"] != "up") touches.push_back({touch["id"], touch["camera_mm"]});
        log_[frame] = std::move(touches);
    }

    void sample(double at_s) {
        next_.at_s = at_s;
        next_.resident_mb = program_.resident_mb();
        next_.open_files = program_.open_files();
        score_.samples.push_back(std::exchange(next_, {}));
        next_sample_ +=
            std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(sample_every_s));
        if (run_.shows_progress)
            std::fprintf(stderr, "\r%.1f of %.0f minutes, %d dropped, %.0f MB ", at_s / 60.0, run_.minutes,
                         score_.dropped, score_.samples.back().resident_mb);
    }

    void finish() {
        const std::vector<double> lags(lags_ms_.begin(), lags_ms_.end());
        score_.median_lag_ms = percentile(lags, 50.0);
        score_.p99_lag_ms = percentile(lags, 99.0);
        score_.worst_lag_ms = percentile(lags, 100.0);
        score_.rate_hz = whole_s_ > 0.0 ? score_.frames / whole_s_ : 0.0;
        compare_ends();
        TouchTruth truth = read_touch_truth(truth_);
        const int first = log_.empty() ? 0 : log_.begin()->first;
        truth.tips.resize(std::min(truth.tips.size(), static_cast<std::size_t>(last_frame_ + 1)));
        gaps_.emplace_back(-1, first);
        leave_out_gaps(gaps_, truth, log_);
        score_.touches = score_touches(truth, log_);
    }

    /// Minute 2 beside the last one, or the first and last quarter of a short run.
    void compare_ends() {
        const double minute_s = std::min(60.0, score_.seconds / 4.0);
        const auto mean = [&](double from_s, double to_s, double& mb, int& files) {
            int samples = 0;
            for (const SoakSample& sample : score_.samples) {
                if (sample.at_s < from_s || sample.at_s > to_s) continue;
                mb += sample.resident_mb;
                files = std::max(files, sample.open_files);
                ++samples;
            }
            if (samples > 0) mb /= samples;
        };
        mean(minute_s, 2.0 * minute_s, score_.start_mb, score_.start_files);
        mean(score_.seconds - minute_s, score_.seconds, score_.end_mb, score_.end_files);
    }

    SoakRun run_;
    TemporaryFolder folder_;
    std::filesystem::path truth_;
    test::WatchedProgram program_;
    SoakScore score_;
    SoakSample next_;
    LagMeter lag_;
    std::vector<float> lags_ms_;
    std::vector<std::pair<int, int>> gaps_;
    TouchLog log_;
    double whole_s_ = 0.0;
    int last_frame_ = -1;
    Clock::time_point start_, next_sample_;
};

std::string curve(const std::string& name, const SoakScore& score, double (*value)(const SoakSample&)) {
    std::string block = "$" + name + " << EOD\n";
    for (const SoakSample& sample : score.samples)
        block += fmt::format("{:.3f} {:.3f}\n", sample.at_s / 60.0, value(sample));
    return block + "EOD\n";
}

}  // namespace

SoakScore run_soak(const SoakRun& run) { return Soak(run).score(); }

void leave_out_gaps(const std::vector<std::pair<int, int>>& gaps, TouchTruth& truth, TouchLog& log) {
    for (const auto& [before, after] : gaps) {
        const int from = std::max(before - beside_fault_frames, 0), to = after + beside_fault_frames;
        for (int frame = from; frame <= to; ++frame) {
            if (frame < std::ssize(truth.tips)) truth.tips[static_cast<std::size_t>(frame)].clear();
            log.erase(frame);
        }
    }
}

std::string text_of(const SoakScore& score) {
    const TouchScore& touches = score.touches;
    return fmt::format(
        "{:.1f} minutes, {} frames, {:.2f} Hz, {} dropped ({:.3f} %), {} faults, {} restarts, exit status "
        "{}\n"
        "lag of a frame: median {:.1f} ms, 99 % {:.1f}, worst {:.1f}\n"
        "memory {:.1f} -> {:.1f} MB, open files {} -> {}\n"
        "contacts of two frames or more: {} of {}, all {} of {}; {} ghosts, {} id switches in {} drags, "
        "{:.2f} mm "
        "off\n",
        score.seconds / 60.0, score.frames, score.rate_hz, score.dropped, 100.0 * score.dropped_share(),
        score.faults, score.restarts, score.exit_status, score.median_lag_ms, score.p99_lag_ms,
        score.worst_lag_ms, score.start_mb, score.end_mb, score.start_files, score.end_files,
        touches.of_two_and_more.found, touches.of_two_and_more.contacts, touches.all.found,
        touches.all.contacts, touches.spurious_ids, touches.drag_id_switches, touches.drags,
        percentile(touches.position_mm, 50.0));
}

std::string gnuplot_script(const SoakScore& score, const std::string& png) {
    std::string script = curve("lag", score, [](const SoakSample& sample) { return sample.worst_lag_ms; }) +
                         curve("memory", score, [](const SoakSample& sample) { return sample.resident_mb; }) +
                         curve("files", score, [](const SoakSample& sample) {
                             return static_cast<double>(sample.open_files);
                         });
    std::string rate = "$rate << EOD\n";
    for (std::size_t i = 1; i < score.samples.size(); ++i) {
        const double seconds = score.samples[i].at_s - score.samples[i - 1].at_s;
        rate +=
            fmt::format("{:.3f} {:.3f}\n", score.samples[i].at_s / 60.0, score.samples[i].frames / seconds);
    }
    script += rate + "EOD\n";
    script += fmt::format(
        "set terminal pngcairo noenhanced size 1000,900 font \"DejaVu Sans,11\"\nset output \"{}\"\nset "
        "grid\n"
        "set key off\nset xlabel \"minutes\"\nset yrange [0:*]\n"
        "set linetype 1 linecolor rgb \"#2a6fbb\"\nset multiplot layout 4,1 title \"{:.0f} minutes, {} "
        "frames, {} "
        "dropped, {} faults\"\n",
        png, score.seconds / 60.0, score.frames, score.dropped, score.faults);
    for (const auto& [name, axis] : {std::pair("rate", "frames a second"), std::pair("lag", "worst lag, ms"),
                                     std::pair("memory", "memory, MB"), std::pair("files", "open files")})
        script += fmt::format("set ylabel \"{}\"\nplot ${} using 1:2 with lines linewidth 2\n", axis, name);
    return script + "unset multiplot\n";
}

}  // namespace touchstone
