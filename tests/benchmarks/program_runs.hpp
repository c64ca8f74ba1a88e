#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace touchstone {

/// What a run of the program took; times in seconds, memory in MB.
struct ProgramRun {
    double first_live_s = 0.0;  ///< from its start to the first live frame in its event log; 0 = none
    double peak_rss_mb = 0.0;
    bool used_saved_scan = false;
};

/// `run` of the program, headless, on the simulated flat table with two hands, at live pace, in a folder
/// that keeps scan and kernel cache from run to run. Throws std::runtime_error where it fails.
ProgramRun run_table(const std::string& program, const std::filesystem::path& folder, int frames);

/// Median of the frame, milliseconds, of `bench --moving` on a recording.
double bench_moving_ms(const std::string& program, const std::filesystem::path& sequence, int voxels);

}  // namespace touchstone
