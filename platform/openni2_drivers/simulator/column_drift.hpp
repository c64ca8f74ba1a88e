#pragma once

#include <cstdint>
#include <vector>

#include "platform/openni2_drivers/simulator/random.hpp"

namespace touchstone::sim {

/// The Kinect's vertical-band correction: for many seconds each band of columns keeps its offset, then all
/// bands change within about 100 frames. Starts from a calibrated sensor.
class ColumnDrift {
  public:
    ColumnDrift(std::uint64_t seed, int width_px);

    /// Offset of each column in steps of the sensor (1/8 px of disparity), -2 to 2. Times must not decrease.
    const std::vector<float>& at(double time_s);

  private:
    Random random_;
    std::vector<int> band_of_column_;
    std::vector<float> from_, to_;  ///< of each band
    double change_s_;               ///< when the next change starts
    std::vector<float> columns_;
};

}  // namespace touchstone::sim
