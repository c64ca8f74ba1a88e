#pragma once

#include <span>
#include <vector>

#include "pipeline/maps.hpp"
#include "pipeline/pixel_region.hpp"
#include "pipeline/tsdf_volume.hpp"
#include "pipeline/types.hpp"
#include "pipeline/volumetric_integration.hpp"

namespace touchstone {

/// Points of one component on a grid of pixels.
struct ComponentPoints {
    PixelRegion region;  ///< all of the component
    std::vector<Eigen::Vector3f> at_c_m;
    std::vector<std::size_t> map_index;  ///< of each point
    Eigen::Vector3f centre_c_m = Eigen::Vector3f::Zero();
};

/// A small volume that moves with what it holds (Fig 14e). Its global frame g is the thing's own: T_g_c
/// changes from frame to frame with the thing's movement. The cube is moved along by whole bricks.
class MovingVolume {
  public:
    /// The cube's middle is the points' middle.
    MovingVolume(const Device& device, const VolumeConfig& config, const MapShape& shape, int id,
                 const ComponentPoints& points);

    int id() const { return id_; }
    const TsdfVolume& volume() const { return volume_; }
    TsdfVolume& volume() { return volume_; }
    const RigidTransform& T_g_c() const { return T_g_c_; }
    /// Of the camera at the last frame p: the movement since then is T_p_c.
    void move(const RigidTransform& T_p_c);
    /// Moves the cube by whole bricks where the points come near to its faces.
    void follow(const ComponentPoints& points);
    /// Forgets bricks that are not near a surface any more.
    void prune();
    void clear();
    /// Layers along global y that the points reach, and those beside them.
    BrickLayers layers(const ComponentPoints& points) const;

    SurfacePrediction prediction;  ///< from the camera of the last frame
    PixelRegion region{};          ///< of it; nothing is predicted elsewhere
    RigidTransform last_step_T_p_c = RigidTransform::Identity();
    Eigen::Vector3f last_centre_c_m = Eigen::Vector3f::Zero();
    int frames = 0;          ///< fused since it was made or cleared
    int frames_missing = 0;  ///< since its component was last seen

  private:
    Eigen::AlignedBox3f bounds_g_m(const ComponentPoints& points) const;

    int id_;
    TsdfVolume volume_;
    RigidTransform T_g_c_ = RigidTransform::Identity();
};

}  // namespace touchstone
