#pragma once

#include <array>
#include <map>
#include <optional>

#include "ui/gestures.hpp"
#include "ui/surface_geometry.hpp"

namespace touchstone {

/// What stands on the table and is moved by fingers: a ball and a model.
class TableThings {
  public:
    static constexpr int ball = 0, model = 1;

    /// Both stand on the plane of the area, side by side in its middle.
    explicit TableThings(const TableFrame& frame);

    void reset();
    /// The thing at a place of the depth picture, the one hit nearest to its middle; a finger's width beside
    /// it counts.
    std::optional<int> hit(const SurfaceGeometry& surface, const Eigen::Vector2f& place_px) const;
    /// A finger that comes down on a thing takes it along: over the table as the finger goes, as high as the
    /// surface under it. Several take it by their mean.
    void on_touch(const TouchEvent& event, const SurfaceGeometry& surface);
    /// Stretches and turns.
    void on_gesture(const Gesture& gesture);
    /// Whether something changed since the last call. A thing dragged beyond the area stays at its edge.
    bool update();

    Eigen::Vector3f foot_g_m(int thing) const { return things_[static_cast<std::size_t>(thing)].foot_g_m; }
    /// The ball's diameter, the model's height.
    float size_m(int thing) const { return things_[static_cast<std::size_t>(thing)].size_m; }
    Eigen::Vector3f middle_g_m(int thing) const;
    /// Takes the model's own frame (y up, on its foot) to the global one.
    RigidTransform T_g_m() const;
    /// The look of the lamp at the model, whose shadow falls along it.
    RigidTransform T_g_l() const;

  private:
    struct Thing {
        Eigen::Vector3f foot_g_m;
        float size_m;
        float yaw_rad = 0.f;
    };
    struct Finger {
        int thing;
        Eigen::Vector3f at_g_m, told_g_m;
    };
    void drag(int thing);
    float height_m(const Eigen::Vector3f& point_g_m) const { return up_g_.dot(point_g_m - origin_g_m_); }

    Eigen::Vector3f origin_g_m_, u_g_m_, v_g_m_, up_g_, light_g_m_;
    std::array<Thing, 2> things_{};
    std::map<int, Finger> fingers_;
    bool is_changed_ = false;
};

}  // namespace touchstone
