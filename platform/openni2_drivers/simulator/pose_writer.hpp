#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>

namespace touchstone::sim {

/// Writes the true poses as TUM RGB-D lines "timestamp tx ty tz qx qy qz qw" (seconds, metres, camera to
/// scene), each flushed: the file is whole after every frame.
class PoseWriter {
  public:
    /// Throws Error{io_error}, as do writes that fail.
    explicit PoseWriter(std::filesystem::path path);

    void add_frame(double time_s, const Eigen::Isometry3d& T_s_c);

  private:
    std::filesystem::path path_;
    std::ofstream file_;
};

}  // namespace touchstone::sim
