#include "app/record_command.hpp"

#include <filesystem>
#include <fmt/format.h>

#include "app/configured_camera.hpp"
#include "app/frame_reading.hpp"
#include "app/progress_line.hpp"
#include "platform/system/atomic_file.hpp"
#include "platform/system/log.hpp"

namespace touchstone {

namespace {

/// What was read while the recorder wrote; in live pace the file may hold some frames that were not read in
/// time.
struct Recorded {
    int frames = 0;
    double seconds = 0.0;          ///< from the first frame to the last, by the source's clock
    std::optional<Error> failure;  ///< that ended it before its time
};

/// The recorder says nothing of a full disk and goes on: end before it.
constexpr std::uintmax_t least_free_bytes = 32'000'000;

void check_space(const std::string& file) {
    std::error_code failure;
    const std::filesystem::space_info space = std::filesystem::space(file, failure);
    if (!failure && space.available < least_free_bytes)
        throw Error(ExitStatus::io_error,
                    fmt::format("recording ends where the disk has {:.0f} MB left: make room",
                                static_cast<double>(space.available) / 1e6));
}

double megabytes(const std::string& file) {
    std::error_code failure;
    const std::uintmax_t bytes = std::filesystem::file_size(file, failure);
    return failure ? 0.0 : static_cast<double>(bytes) / 1e6;
}

std::string progress_text(const Recorded& recorded, const RecordOptions& options, const std::string& file) {
    const std::string of_wanted = options.frames ? fmt::format(" of {}", *options.frames) : "";
    return fmt::format("recording: {}{} frames, {:.1f} s, {:.1f} MB", recorded.frames, of_wanted,
                       recorded.seconds, megabytes(file));
}

/// Reads until the wanted frames, the source, the camera or a signal ends it.
Recorded read_frames(DepthCamera& camera, const RecordOptions& options, const std::string& file,
                     TerminationSignals& signals) {
    Recorded recorded;
    std::uint64_t begin_us = 0;
    ProgressLine progress;
    try {
        while (!options.frames || recorded.frames < *options.frames) {
            check_space(file);
            const std::optional<DepthFrame> frame = read_frame(camera, signals);
            if (!frame) break;
            if (recorded.frames++ == 0) begin_us = frame->timestamp_us;
            recorded.seconds =
                1e-6 * (static_cast<double>(frame->timestamp_us) - static_cast<double>(begin_us));
            progress.show(progress_text(recorded, options, file));
        }
    } catch (const Error& error) {
        recorded.failure = error;
    }
    return recorded;
}

Recorded record(const RecordOptions& options, const std::string& file, TerminationSignals& signals) {
    DepthCamera camera = configured_camera(options.config, options.pace, options.with_color);
    log_info("reading {}", camera.name());
    if (options.with_color && !camera.has_color())
        log_warning("{} has no colour: only depth is recorded", camera.name());
    camera.start_recording(file);
    Recorded recorded = read_frames(camera, options, file, signals);
    if (recorded.failure && recorded.frames == 0) throw *recorded.failure;
    if (recorded.frames == 0)
        throw Error(ExitStatus::unavailable, camera.name() + " gave no frame; nothing is written");
    camera.stop_recording();
    return recorded;
}

}  // namespace

ExitStatus record_command(const RecordOptions& options) {
    set_log_level(log_level(options.config));
    const std::string& file = options.oni_file;
    if (!file.ends_with(".oni"))
        throw Error(ExitStatus::usage, file + " is to be an OpenNI recording: let its name end in .oni");
    PendingFile pending(file);
    TerminationSignals signals;
    const Recorded recorded = record(options, pending.name(), signals);
    pending.commit();
    log_info("{}: {} frames, {:.1f} s, {:.1f} MB", file, recorded.frames, recorded.seconds, megabytes(file));
    if (recorded.failure)
        throw Error(recorded.failure->status(), fmt::format("{}; the {} frames before that are in {}",
                                                            recorded.failure->what(), recorded.frames, file));
    return ExitStatus::ok;
}

}  // namespace touchstone
