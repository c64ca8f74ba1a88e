#pragma once

#include <optional>

#include "pipeline/touch_event.hpp"
#include "ui/canvas.hpp"
#include "ui/surface_geometry.hpp"
#include "ui/view_mapping.hpp"

namespace touchstone {

/// A round pad at the lower right of the interactive area. A finger drags its knob; let go, it springs back.
class TiltPad {
  public:
    /// True when the finger came down on the pad, or did and is still told of.
    bool on_touch(const TouchEvent& event);
    void update(float dt_s);
    void cancel() { finger_.reset(); }
    /// The knob from the middle: length at most 1, right and down of the picture.
    const Eigen::Vector2f& offset() const { return offset_; }
    /// For the touches to come.
    void lay_out(const SurfaceGeometry& surface);
    void draw(Canvas& canvas, const ViewMapping& view) const;

    /// In the depth picture.
    const Eigen::Vector2f& center_px() const { return center_px_; }
    float radius_px() const { return radius_px_; }

  private:
    Eigen::Vector2f center_px_{0.f, 0.f}, offset_{0.f, 0.f};
    float radius_px_ = 0.f;
    std::optional<int> finger_;
};

}  // namespace touchstone
