#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace touchstone {

enum class ReportedPhase { down, move, up };

/// A finger as it leaves the process. camera_mm is the point on the surface; surface is 0..1 over the
/// interactive area.
struct ReportedFinger {
    int id = 0;
    ReportedPhase phase = ReportedPhase::down;  ///< of a touch; without meaning for a hover
    std::array<double, 3> camera_mm{};
    std::array<double, 2> surface{};
    double height_mm = 0.0;
    std::string area{};                    ///< name; empty: of none, or the table has none
    std::array<double, 2> area_surface{};  ///< 0..1 over that area
};

/// A rigid object of known shape in a hand: searching, tracked or lost; where it is while tracked.
struct ReportedObject {
    std::string state;
    std::string reason;                  ///< in words, empty when all is well
    std::array<double, 3> camera_mm{};   ///< origin of the model's frame (of its mesh), in the camera's
    std::array<double, 4> quaternion{};  ///< x, y, z, w: the model's axes in the camera's
};

/// Everything one processed frame tells the outside.
struct TouchReport {
    int frame = 0;
    std::uint64_t time_us = 0;
    std::string state;
    std::vector<ReportedFinger> touches;
    std::vector<ReportedFinger> hovers;
    std::optional<ReportedObject> object{};  ///< while one is looked for
};

/// Takes the report of each processed frame: event log, TUIO.
class TouchSink {
  public:
    virtual ~TouchSink() = default;
    virtual void publish(const TouchReport& report) = 0;
    /// All touches end and no frame is coming: the sensor is lost.
    virtual void release_all() {}
    /// Called some ten times a second while no frame is coming, for sinks whose listeners expect a sign of
    /// life.
    virtual void idle() {}
};

}  // namespace touchstone
