#pragma once

#include "pipeline/reconstruction.hpp"
#include "tests/support/oriented_scene.hpp"

namespace touchstone::test {

/// A reconstruction of a scene that is given in the frame s of the first camera; 128^3 voxels of 12.5 mm.
class ReconstructedScene {
  public:
    explicit ReconstructedScene(OrientedSurface scene, bool use_color = true)
        : scene_(std::move(scene)), reconstruction(device_, config(use_color), k, T_g_s) {}

    /// Depths in millimetres of the camera at T_s_c.
    std::vector<std::uint16_t> seen_mm(const RigidTransform& T_s_c) const {
        return to_mm(view_of(k, scene_, T_s_c).depth_m);
    }
    ReconstructionFrame process(const RigidTransform& T_s_c) { return process_mm(seen_mm(T_s_c)); }
    ReconstructionFrame process_mm(const std::vector<std::uint16_t>& depth_mm,
                                   const std::vector<std::uint8_t>& rgb = {}) {
        return reconstruction.process({depth_mm, k}, rgb);
    }
    /// Of the last pose.
    PoseError error(const RigidTransform& T_s_c) const {
        return pose_error(reconstruction.T_g_c(), T_g_s * T_s_c);
    }
    /// All voxels, to see whether any changed.
    std::vector<std::int32_t> voxels() const {
        std::vector<std::int32_t> values = reconstruction.volume().pool().read();
        values.resize(static_cast<std::size_t>(reconstruction.volume().bricks_in_use()) * BRICK_VOXELS);
        return values;
    }

    static ReconstructionConfig config(bool use_color) {
        ReconstructionConfig config;
        config.volume.size_vox = 128;
        config.volume.side_m = 1.6f;
        config.use_color = use_color;
        return config;
    }

    const Intrinsics k = small_camera(160, 120);
    /// The cube begins 0.2 m before the first camera.
    const RigidTransform T_g_s = moved({800.0f, 800.0f, -200.0f});

  private:
    const Device device_{DeviceConfig{}};
    OrientedSurface scene_;

  public:
    Reconstruction reconstruction;
};

}  // namespace touchstone::test
