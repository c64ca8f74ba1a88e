#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "pipeline/table_picture.hpp"

namespace touchstone {

struct LowEndConfig {
    float radius_m = 0.034f;       ///< a fingertip and its first joint
    float step_m = 0.012f;         ///< neighbouring pixels farther apart belong to different fingers
    float most_area_m2 = 0.0020f;  ///< of the points: a finger and its neighbours; more is a palm or an arm
    float ring_m = 0.022f;         ///< of a ring of pixels around a finger's end ...
    float most_of_ring = 0.5f;     ///< ... no more is foreground than this
    float edge_height_m = 0.004f;  ///< pixels beside the mask this high are its lost edge
};

/// A low end of the foreground with the connected points around it, camera frame.
struct LowEnd {
    Eigen::Vector3f seed_m{0.f, 0.f, 0.f};
    std::vector<Eigen::Vector3f> points_m;
    std::vector<Eigen::Vector2f> pixels_px;  ///< of the points
};

/// Whether a pixel is foreground with a depth and a height.
inline bool is_foreground(const TablePicture& picture, std::size_t at) {
    return picture.mask[at] != 0 && picture.live_m[at] > 0.0f && picture.height_m[at] < UNKNOWN_HEIGHT_M;
}

/// Grows from a pixel over foreground without steps, up to a distance from the pixel's point.
class LowEndFlood {
  public:
    LowEndFlood(const TablePicture& picture, const LowEndConfig& config)
        : picture_(picture), config_(config) {}

    /// Without points where the surroundings are too wide for a finger.
    LowEnd from(int x, int y);

  private:
    bool is_surrounded(int x, int y, const Eigen::Vector3f& seed_m) const;
    Eigen::Vector3f point(int x, int y) const;
    std::uint8_t& seen(int x, int y);
    void visit(int x, int y, const Eigen::Vector3f& at_m, LowEnd& end);
    void step_around(int from_x, int from_y, LowEnd& end);

    const TablePicture& picture_;
    LowEndConfig config_;
    int origin_x_ = 0, origin_y_ = 0, side_px_ = 0;
    std::vector<std::uint8_t> seen_;
    std::vector<std::pair<int, int>> stack_;
};

}  // namespace touchstone
