#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "platform/system/stage_timer.hpp"
#include "platform/system/temperatures.hpp"

namespace touchstone {

/// How a running table does. Counts are since its start.
struct HealthFigures {
    std::string state;
    std::uint64_t frames = 0;                        ///< processed
    std::uint64_t missed_frames = 0;                 ///< that the camera should have given, by its clock
    std::optional<std::uint64_t> lost_packets;       ///< on USB, of cameras that tell
    std::uint64_t touches = 0;                       ///< that went down
    std::map<std::string, std::uint64_t> faults;     ///< of the camera, by kind
    std::map<std::string, std::uint64_t> restarts;   ///< of the camera, by what was done
    std::map<std::string, std::uint64_t> unsaved{};  ///< what could not be written to the disk
    std::optional<double> projector_off_mm;          ///< where its light fell when it was last looked at
    double frame_rate_hz = 0.0;
    double resident_mb = 0.0;
    std::vector<StageSummary> stages;
    std::vector<Temperature> temperatures;
};

/// The figures as a Prometheus text page at http://127.0.0.1:PORT/metrics, served by threads of its own.
/// Nobody else on the network reaches it.
class HealthPage {
  public:
    /// Throws Error{unavailable} where the port is taken. Port 0: any free one.
    explicit HealthPage(int port);
    ~HealthPage();
    HealthPage(const HealthPage&) = delete;
    HealthPage& operator=(const HealthPage&) = delete;

    int port() const;
    /// What is served from now on.
    void show(const HealthFigures& figures);

  private:
    struct Server;
    std::unique_ptr<Server> server_;
};

}  // namespace touchstone
