#pragma once

#include <map>
#include <vector>

#include "pipeline/scene_wish.hpp"
#include "ui/table_frame.hpp"

namespace touchstone {

/// Frames of a made-up table, 640 x 480, a camera 1.1 m above it: two people paint, drag, pinch and tap all
/// over it, tools included, while an arm goes to and fro. The same calls give the same frames.
class SceneVisit {
  public:
    SceneVisit();

    /// The next frame, 1/30 s later, with what the scene wished for.
    TableFrame next(const SceneWish& wish);

  private:
    void touch(TableFrame& frame);
    void finger(TableFrame& frame, int finger, bool down, const Eigen::Vector2f& place_px);
    std::shared_ptr<const ShadedView> view() const;
    std::shared_ptr<const ParticleView> particles() const;

    TableFrame base_;
    std::vector<std::uint16_t> depth_mm_;
    std::map<int, int> ids_;  // by finger, while it touches
    std::vector<Eigen::Vector2f> last_px_;
    int ids_given_ = 0, index_ = 0;
};

}  // namespace touchstone
