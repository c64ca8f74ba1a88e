#pragma once

#include <cstdint>
#include <vector>

#include "platform/openni2_drivers/simulator/geometry.hpp"
#include "platform/openni2_drivers/simulator/simulator_config.hpp"

namespace touchstone::sim {

/// A thing on the table, in the scene frame s: metres, x to the right of the picture, y away from the
/// camera's foot, z up, the table is z = 0, the optical axis meets the origin.
struct Shape {
    enum class Kind { box, ball, can, bowl, ridge };
    Kind kind = Kind::box;
    Vec3 center =
        Vec3::Zero();  ///< box, ball, can: the middle; bowl: the ball's middle; ridge: on the axis, z = 0
    Vec3 half = Vec3::Zero();           ///< box: half sides; can: (radius, -, half height)
    Eigen::Vector2f along{1.0F, 0.0F};  ///< on the table: of the box's x, of the ridge's axis
    float radius_m =
        0.0F;  ///< ball; bowl: the wall's middle; ridge: the convex arc; box, can: the edges' rounding
    float depth_m = 0.0F;      ///< bowl: from rim to bottom; ridge: height over the table
    float thickness_m = 0.0F;  ///< bowl: half the wall; ridge: radius of the fillet to the table
    Vec3 albedo = Vec3::Constant(0.5F);

    /// Signed distance; exact outside.
    float distance(const Vec3& p_s) const;
    /// At most the distance; cheap.
    float distance_bound(const Vec3& p_s) const;
};

/// The static world: the table and the things on it.
class Scene {
  public:
    explicit Scene(std::vector<Shape> shapes) : shapes_(std::move(shapes)) {}

    /// Signed distance in metres from the nearest surface, positive in free space.
    float distance(const Vec3& p_s) const;
    Vec3 normal(const Vec3& p_s) const;
    /// The shape nearest to a point, -1 for the table.
    int nearest(const Vec3& p_s) const;
    /// Height of the middle of a ball of this radius that is lowered at (x, y) until it touches.
    float resting_height_m(float x_m, float y_m, float radius_m) const;
    const std::vector<Shape>& shapes() const { return shapes_; }

  private:
    std::vector<Shape> shapes_;
};

/// Objects are scattered from the seed so that they lie within `reach_m` of the origin.
Scene make_scene(SimulatedScene kind, std::uint64_t seed, float reach_m);

}  // namespace touchstone::sim
