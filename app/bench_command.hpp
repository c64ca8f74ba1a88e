#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/command_line.hpp"
#include "platform/system/error.hpp"
#include "platform/system/stage_timer.hpp"
#include "platform/system/termination_signals.hpp"

namespace touchstone {

/// What `touchstone bench` measured.
struct BenchResult {
    std::string device;
    StageSummary frame;                ///< the whole loop of a frame; `frames` of them
    std::vector<StageSummary> stages;  ///< of it, in the order in which they ran
    double peak_rss_mb = 0.0, volume_mb = 0.0;
    std::optional<StageSummary> touch_to_photon = {};  ///< where pictures were drawn
};

/// {"device":..,"frames":n,"frame_ms":{"median":..,"p99":..},"stages":{NAME:{"median_ms":..,"p99_ms":..}},
/// "peak_rss_mb":..,"volume_mb":..}, with "touch_to_photon_ms":{"median":..,"p99":..} where pictures were
/// drawn.
std::string bench_json(const BenchResult& result);
/// A table for people.
std::string bench_table(const BenchResult& result);

/// Measures; throws Error, also where a signal ends it.
BenchResult measure_frames(const BenchOptions& options, TerminationSignals& signals);

/// `touchstone bench`: the live loop of `run`, or of `track`, over the last 300 frames; reading frames is not
/// counted, scanning neither. With a display, pictures are drawn between the stages that are measured. Throws
/// Error.
ExitStatus bench_command(const BenchOptions& options);

}  // namespace touchstone
