#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/accuracy/touch_series.hpp"

namespace touchstone {

/// What hands do over a simulated table: they touch it as people do, hover 15 to 200 mm or 2 to 20 mm above
/// it and never touch, or are not there.
enum class HandPlay { touching, hovering, hovering_low, none };

/// A sequence of a simulated table. The first four seconds show it without hands.
struct TableSequence {
    std::string surface = "flat";
    int seed = 1;
    int frames = 900;
    double height_m = 1.0;  ///< of the camera over the table
    double tilt_deg = 25.0;
    HandPlay hands = HandPlay::touching;
    bool drift =
        true;  ///< bands of columns wander by up to two steps of the sensor, as a warming Kinect's do
};

/// The sensor URI after `sim:`; sleeves are drawn from the seed.
std::string scene_of(const TableSequence& sequence);

/// 0 to 40 degrees, even over the seeds.
double drawn_tilt_deg(int seed);

/// One detector on all sequences shown so far.
struct MethodSeries {
    std::string method;
    TouchSeries series;
};

/// Shows sequences to the program and to all baselines, and keeps what they report.
class Evaluation {
  public:
    /// `program` is touchstone's file.
    explicit Evaluation(std::string program) : program_(std::move(program)) {}

    /// Throws std::runtime_error where the program fails.
    void add(const TableSequence& sequence);
    void add(const Evaluation& other);
    /// Ours first.
    const std::vector<MethodSeries>& methods() const { return methods_; }

  private:
    TouchSeries& series_of(std::size_t place, const std::string& method);

    std::string program_;
    std::vector<MethodSeries> methods_;
};

}  // namespace touchstone
