#include "app/fault_reports.hpp"

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fmt/chrono.h>
#include <iterator>
#include <pthread.h>
#include <regex>
#include <utility>

#include "platform/image/png_file.hpp"
#include "platform/system/atomic_file.hpp"
#include "platform/system/log.hpp"

namespace touchstone {

namespace {

namespace fs = std::filesystem;

constexpr double span_s = 10.0;
constexpr std::size_t most_ring_bytes = 40'000'000, most_waiting_frames = 4;
constexpr const char* unfinished = ".new";

fs::path new_report(const fs::path& dir, const std::string& reason) {
    const std::string name =
        fmt::format("fault-{:%Y%m%d-%H%M%S}-{}", fmt::gmtime(std::time(nullptr)), reason);
    fs::path path = dir / name;
    for (int number = 2; fs::exists(path); ++number) path = dir / fmt::format("{}-{}", name, number);
    return path;
}

void write_frames(const FrameRing& ring, const fs::path& folder) {
    const Intrinsics& k = ring.intrinsics();
    write_file_atomically(folder / "camera-intrinsics.txt",
                          fmt::format("{} 0 {}\n0 {} {}\n0 0 1\n", k.fx_px, k.cx_px, k.fy_px, k.cy_px));
    for (std::size_t i = 0; i < ring.frames(); ++i) {
        DepthFrame frame = ring.frame(i);
        write_png(folder / fmt::format("frame-{:06}.depth.png", frame.index),
                  Image16{frame.width_px, frame.height_px, std::move(frame.depth_mm)});
    }
}

/// The whole report or none of it. Throws std::exception.
fs::path write_report(const FrameRing& ring, const fs::path& dir, const std::string& reason) {
    fs::create_directories(dir);
    const fs::path report = new_report(dir, reason), beside = report.string() + unfinished;
    try {
        fs::create_directory(beside);
        write_frames(ring, beside);
        fs::rename(beside, report);
    } catch (const std::exception&) {
        std::error_code ignored;
        fs::remove_all(beside, ignored);
        throw;
    }
    return report;
}

/// Deletes all reports but the newest, and what a power cut left of one. Throws fs::filesystem_error.
void delete_old_reports(const fs::path& dir, std::size_t most) {
    static const std::regex ours("fault-[0-9]{8}-[0-9]{6}-[a-z]+(-[0-9]+)?(\\.new)?");
    std::vector<fs::path> reports;
    for (const fs::directory_entry& entry : fs::directory_iterator(dir)) {
        if (entry.is_symlink() || !entry.is_directory()) continue;
        if (!std::regex_match(entry.path().filename().string(), ours)) continue;
        if (entry.path().extension() == unfinished)
            fs::remove_all(entry.path());
        else
            reports.push_back(entry.path());
    }
    std::ranges::sort(reports);
    for (std::size_t i = 0; i + most < reports.size(); ++i) fs::remove_all(reports[i]);
}

/// A thread that wakes up would otherwise take the core from the loop that woke it, for a whole frame.
void wait_for_a_free_core() {
    const sched_param no_priority{};
    pthread_setschedparam(pthread_self(), SCHED_BATCH, &no_priority);
}

}  // namespace

FaultReports::FaultReports(FaultReportsConfig config)
    : config_(std::move(config)),
      ring_(span_s, most_ring_bytes),
      worker_([this](const std::stop_token& stop) { work(stop); }) {}

DepthFrame FaultReports::spare_frame() {
    const std::lock_guard lock(mutex_);
    if (spare_.empty()) return {};
    DepthFrame frame = std::move(spare_.back());
    spare_.pop_back();
    return frame;
}

void FaultReports::keep(const DepthFrame& frame) {
    skip_ = !skip_;
    if (!skip_) return;
    DepthFrame copy = spare_frame();
    copy = frame;
    {
        const std::lock_guard lock(mutex_);
        std::vector<DepthFrame>& target = inbox_.size() < most_waiting_frames ? inbox_ : spare_;
        target.push_back(std::move(copy));
    }
    changed_.notify_one();
}

void FaultReports::report(std::string_view reason) {
    const std::lock_guard lock(mutex_);
    if (!wanted_.empty()) {
        log_warning("no fault report ({}): one is being written", reason);
        return;
    }
    wanted_ = reason;
    changed_.notify_one();
}

void FaultReports::work(const std::stop_token& stop) {
    wait_for_a_free_core();
    std::unique_lock lock(mutex_);
    while (changed_.wait(lock, stop, [this] { return !inbox_.empty() || !wanted_.empty(); })) {
        std::vector<DepthFrame> frames = std::exchange(inbox_, {});
        const std::string reason = wanted_;
        lock.unlock();
        take(frames, reason);
        lock.lock();
        std::ranges::move(frames, std::back_inserter(spare_));
        if (!reason.empty()) wanted_.clear();
    }
}

void FaultReports::take(const std::vector<DepthFrame>& frames, const std::string& reason) {
    try {
        for (const DepthFrame& frame : frames) ring_.add(frame);
        if (reason.empty() || ring_.frames() == 0) return;
        const fs::path report = write_report(ring_, config_.dir, reason);
        log_info("fault report: {} frames in {}", ring_.frames(), report.string());
        ring_.clear();
        delete_old_reports(config_.dir, static_cast<std::size_t>(config_.most));
    } catch (const std::exception& error) {
        log_warning("fault reports: {}", error.what());
    }
}

}  // namespace touchstone
