#pragma once

#include <optional>
#include <span>
#include <vector>

#include "pipeline/depth_patch.hpp"
#include "pipeline/objects_config.hpp"
#include "pipeline/raycasting.hpp"
#include "pipeline/tsdf_volume.hpp"
#include "pipeline/volumetric_integration.hpp"

namespace touchstone {

/// Things that were put down. Each has a volume of its own on the background's grid and lies over the
/// background's prediction; the background itself is never changed by it and is there again when it goes.
class SettledObjects {
  public:
    SettledObjects(const Device& device, const ObjectsConfig& config, const Intrinsics& intrinsics);

    /// `grid`: of the background's volume.
    void add(const DepthPatch& patch, const VolumeConfig& grid, const RigidTransform& T_g_c);
    /// Drops those whose place shows what is behind them; gives their boxes.
    std::vector<PixelRegion> drop_taken(const ObjectFrame& frame);
    /// Sees them from another camera pose.
    void move_camera(const RigidTransform& T_g_c);
    void clear();

    bool empty() const { return objects_.empty(); }
    int count() const { return static_cast<int>(objects_.size()); }
    std::size_t memory_bytes() const;
    /// Lays their surfaces over the prediction where they are nearer.
    void lay_over(SurfacePrediction& prediction);
    /// 255 on them and some pixels around, else 0; row by row with the map's padding.
    const std::vector<std::uint8_t>& cover() const { return cover_; }

  private:
    struct Object {
        TsdfVolume volume;
        Eigen::Vector3f corner_g_m;  ///< of its volume in the background's
        DepthPatch seen;
        std::vector<Eigen::Vector3f> normals_c;  ///< of each pixel of `seen`
        int taken_frames = 0, shifted_frames = 0;
    };

    Object make(const DepthPatch& patch, const VolumeConfig& grid, const RigidTransform& T_g_c);
    void fuse(Object& object, const DepthPatch& patch, const RigidTransform& T_g_c);
    void see(Object& object, const DepthPatch* measured, const RigidTransform& T_g_c);
    bool is_taken(Object& object, const ObjectFrame& frame) const;
    void compose();
    void cover_around(int x, int y);

    const Device* device_;
    ObjectsConfig config_;
    Intrinsics intrinsics_;
    MapShape shape_;
    Program program_;
    Kernel lay_over_;
    VolumetricIntegration integration_;
    Raycasting raycasting_;
    std::vector<Object> objects_;
    SurfacePrediction over_;        ///< all of them
    std::vector<float> nearest_m_;  ///< its depth
    std::vector<std::uint8_t> cover_;
};

/// Normals of a patch from its neighbouring depths, facing the camera; zero where there is none.
std::vector<Eigen::Vector3f> patch_normals_c(const DepthPatch& patch, const Intrinsics& intrinsics);

}  // namespace touchstone
