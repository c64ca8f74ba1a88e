#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

#include "platform/openni2_drivers/simulator/geometry.hpp"

namespace touchstone::sim {

/// One fingertip that is in use, as the scorers read it.
struct TipTruth {
    int hand = 0;
    int finger = 0;                 ///< 0 index, 1 thumb
    float gap_mm = 0.0F;            ///< of the pad from the surface, >= 0
    Vec3 camera_mm = Vec3::Zero();  ///< the point of the surface under the pad, camera frame
};

/// Writes {"fps":..,"frames":n,"tips":[[...],...]}. The file is whole and valid after each frame, even when
/// the process is killed: a frame overwrites the closing brackets, then the count in its fixed-width field.
class TruthWriter {
  public:
    /// Throws Error{io_error}, as do writes that fail.
    TruthWriter(std::filesystem::path path, double rate_hz);

    void add_frame(const std::vector<TipTruth>& tips);

  private:
    std::filesystem::path path_;
    std::ofstream file_;
    std::streamoff count_at_ = 0;
    std::streamoff end_at_ = 0;  ///< of the last frame, before the closing brackets
    int frames_ = 0;
};

}  // namespace touchstone::sim
