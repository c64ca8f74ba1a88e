#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

namespace touchstone {

/// What stands for libfreenect in the tests of the driver: the test program exports libfreenect's functions,
/// which the loader prefers to the library's. Nothing here knows of the driver.
struct ScriptedFreenect {
    static ScriptedFreenect& instance();

    std::atomic<int> devices = 0;
    std::atomic<bool> opens = true;
    std::atomic<bool> has_motor = true;
    std::atomic<bool> starts = true;
    std::atomic<bool> gone = false;          ///< process_events reports a dead device
    std::atomic<std::uint16_t> raw = 800;    ///< of every depth pixel but the first, which is invalid
    std::atomic<std::uint32_t> ticks = 600;  ///< of the next picture; 2'000'000 more for each
    std::atomic<bool> own_calibration = false;
    std::atomic<int> loses_packets = 0;  ///< in the next call of process_events, told once in the log

    std::atomic<int> contexts = 0, opened = 0, depth_streams = 0, color_streams = 0;
    std::atomic<int> color_starts = 0, registrations = 0, led = -1;
    std::atomic<int> auto_exposure = 1, auto_white_balance = 1;
    std::atomic<bool> takes_flags = true;
    std::atomic<double> tilt_deg = 0;
};

}  // namespace touchstone
