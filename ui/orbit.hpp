#pragma once

#include <Eigen/Geometry>

#include "ui/similarity.hpp"
#include "ui/table_frame.hpp"

namespace touchstone {

/// A view that is turned about a point of the scan by fingers. It starts as the camera's.
class Orbit {
  public:
    /// About the point of the area's plane that the camera sees in the middle of its picture.
    explicit Orbit(const TableFrame& frame);

    /// As the camera sees it.
    void reset();
    /// The finger went so far: sideways turns about the area's normal, up and down tilts; the point under the
    /// middle stays. It never goes below the surface or over the top.
    void turn(const Eigen::Vector2f& delta_px);
    /// The scan goes along with the fingers, as far as the point in the middle is away.
    void move(const Eigen::Vector2f& delta_px);
    /// Fingers that stretch and turn: nearer or farther, between limits, and a roll about the line of sight.
    void transform(const Similarity& delta);

    RigidTransform T_g_v() const;
    /// Of the line of sight over the surface, radians.
    float elevation_rad() const;
    float distance_m() const { return distance_m_; }

  private:
    void turn_about(const Eigen::Vector3f& axis_g, float angle_rad);

    Intrinsics intrinsics_;
    RigidTransform T_g_c_;
    Eigen::Vector3f up_g_;
    Eigen::Vector3f first_target_g_m_, target_g_m_;
    Eigen::Matrix3f R_g_v_;
    float first_distance_m_ = 1.f, distance_m_ = 1.f;
};

}  // namespace touchstone
