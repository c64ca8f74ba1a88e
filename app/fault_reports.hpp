#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "app/frame_ring.hpp"

namespace touchstone {

struct FaultReportsConfig {
    std::string dir;  ///< empty: none are written
    int most = 5;     ///< older ones are deleted
};

/// What the camera gave in the ten seconds before it failed, as folders that `--sensor seq:DIR` replays:
/// dir/fault-YYYYMMDD-HHMMSS-REASON, UTC, with a number behind it where it exists. Every second frame is
/// kept, and a thread of its own packs and writes: the caller's costs are a copy of the depth. A report that
/// cannot be written is a warning.
class FaultReports {
  public:
    explicit FaultReports(FaultReportsConfig config);
    /// Returns when the report that was asked for is written.
    ~FaultReports() = default;
    FaultReports(const FaultReports&) = delete;
    FaultReports& operator=(const FaultReports&) = delete;

    /// Frames that come while a report is written, or faster than they are packed, are left out.
    void keep(const DepthFrame& frame);
    /// Writes what was kept since the last report; `reason` is one word of small letters. Dropped while one
    /// is written.
    void report(std::string_view reason);

  private:
    void work(const std::stop_token& stop);
    void take(const std::vector<DepthFrame>& frames, const std::string& reason);
    DepthFrame spare_frame();

    FaultReportsConfig config_;
    FrameRing ring_;  ///< the worker's own
    bool skip_ = false;
    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::vector<DepthFrame> inbox_;
    std::vector<DepthFrame> spare_;  ///< their memory is used again: fresh pages cost more than the copy
    std::string wanted_;   ///< reason of the report that is to be written, or is being written; else empty
    std::jthread worker_;  ///< last: it ends before what it uses
};

}  // namespace touchstone
