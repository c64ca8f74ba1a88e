#include "platform/openni2_drivers/simulator/pose_writer.hpp"

#include <fmt/core.h>

#include "platform/system/error.hpp"

namespace touchstone::sim {

PoseWriter::PoseWriter(std::filesystem::path path)
    : path_(std::move(path)), file_(path_, std::ios::binary | std::ios::trunc) {
    if (!file_)
        throw Error(
            ExitStatus::io_error,
            fmt::format("cannot write the pose file {}: check the folder and the disk", path_.string()));
}

void PoseWriter::add_frame(double time_s, const Eigen::Isometry3d& T_s_c) {
    const Eigen::Quaterniond q(T_s_c.linear());
    const Eigen::Vector3d t = T_s_c.translation();
    file_ << fmt::format("{:.9f} {:.12g} {:.12g} {:.12g} {:.12g} {:.12g} {:.12g} {:.12g}\n", time_s, t.x(),
                         t.y(), t.z(), q.x(), q.y(), q.z(), q.w())
          << std::flush;
    if (!file_)
        throw Error(ExitStatus::io_error,
                    fmt::format("cannot write the pose file {}: the disk may be full", path_.string()));
}

}  // namespace touchstone::sim
