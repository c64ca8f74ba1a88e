#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "pipeline/maps.hpp"
#include "pipeline/ray_skipping.hpp"
#include "pipeline/raycasting.hpp"
#include "pipeline/scene_wish.hpp"
#include "pipeline/tsdf_volume.hpp"
#include "pipeline/types.hpp"
#include "platform/opencl/program.hpp"

namespace touchstone {

/// How surfaces look: colours 0..1, shares of the light 0..1.
struct ViewLook {
    Eigen::Vector3f surface{0.62f, 0.66f, 0.72f};     ///< where the volume keeps no colour
    Eigen::Vector3f unknown{0.055f, 0.063f, 0.078f};  ///< where nothing is to be seen
    /// What mirrored rays see that meet nothing, from straight down to straight up.
    Eigen::Vector3f sky_low{0.20f, 0.22f, 0.26f}, sky_high{0.55f, 0.63f, 0.75f};
    Eigen::Vector3f up_g{0.0f, -1.0f, 0.0f};  ///< length 1
    float ambient = 0.30f;
    float diffuse = 0.70f;
    float specular = 0.20f;           ///< times cos^16 of the angle between mirrored light and view
    float mirror = 0.90f;             ///< of what is seen in the sphere
    float grazing_angle_deg = 80.0f;  ///< light that falls in more aslant than this fades, to nothing at 90
    float shadow_start_vox = 2.0f;    ///< height over their surface at which shadow rays start
};

/// A rasterised virtual mesh in the pixels of the view (Fig 12 a, b). A pixel without mesh has depth 0.
struct MeshMaps {
    const Buffer<float>& depth_m;
    const Buffer<float>& normals_c;     ///< planes x, y, z; unit length, facing the camera
    const Buffer<std::uint32_t>& rgba;  ///< red in the lowest byte; alpha is not looked at
};

/// The mesh's depths as the light sees it, padded to `make_map_shape(intrinsics)`.
struct MeshShadow {
    const Buffer<float>& depth_m;
    Intrinsics intrinsics;
    RigidTransform T_l_g;
};

/// What is lit: everything virtual, and the light, a point.
struct ViewScene {
    Eigen::Vector3f light_g_m;
    std::optional<MirrorSphere> sphere = std::nullopt;
    const MeshMaps* mesh = nullptr;
    const MeshShadow* mesh_shadow = nullptr;  ///< without one, the mesh casts none
    /// Normals and colours are not lit; colours are where the volume keeps some.
    ViewStyle style = ViewStyle::shaded;
};

enum class ViewQuality {
    full,
    half  ///< every second column and row is cast and lit, the others repeat it: while the view moves
};

/// Listing 3 in full, Fig 12: a volume from any 6DOF view, lit by Phong's model, with shadows, a mirror
/// sphere and a mesh that hide and are hidden as their depths say. The mesh is
/// not seen in the mirror. Surfaces seen from behind are unknown.
class ViewRendering {
  public:
    /// `intrinsics`: of the view.
    ViewRendering(const Device& device, const ViewLook& look, const Intrinsics& intrinsics);

    /// Casts and lights. RGBA, premultiplied; alpha 255 but in the style over_camera.
    ShadedView render(const TsdfVolume& volume, const RigidTransform& T_g_c, const ViewScene& scene,
                      ViewQuality quality = ViewQuality::full);
    /// Lights a surface that was cast from this pose already.
    ShadedView light(const TsdfVolume& volume, const RigidTransform& T_g_c, const SurfacePrediction& surface,
                     const ViewScene& scene);
    /// Of the last view: depth z, metres, of what each pixel shows, sphere and mesh too; 0 where that is
    /// unknown.
    const Buffer<float>& depth_m() const { return picture_.depth_m; }

  private:
    struct Picture {
        Picture(const Device& device, const MapShape& map_shape)
            : shape(map_shape), rgba(device, map_pixels(map_shape)), depth_m(device, map_pixels(map_shape)) {}
        MapShape shape;
        Buffer<std::uint32_t> rgba;
        Buffer<float> depth_m;
    };
    /// Half as many columns and rows.
    struct HalfView {
        HalfView(const Device& device, const Intrinsics& half);
        Intrinsics intrinsics;
        Raycasting raycasting;
        SurfacePrediction surface;
        Picture picture;
    };

    void launch(const TsdfVolume& volume, const RigidTransform& T_g_c, const SurfacePrediction& surface,
                const ViewScene& scene, const Intrinsics& intrinsics, int mesh_step, Picture& picture);
    bool update_color_table(const TsdfVolume& volume);

    const Device* device_;
    ViewLook look_;
    Intrinsics intrinsics_;
    Program lighting_, spreading_;
    Kernel light_view_, spread_view_;
    RaySkipping skipping_;
    Raycasting raycasting_;
    SurfacePrediction surface_;
    Picture picture_;
    std::optional<HalfView> half_;  ///< from the first view of that quality on
    Buffer<int> color_table_;       ///< colour slot of each brick, -1 where it has none
    Buffer<std::uint32_t> no_colors_;
};

}  // namespace touchstone
