#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "pipeline/types.hpp"

namespace touchstone {

/// Where the lamp of rendered views hangs: 0.9 m over the plane of the area, its first corner's quarter.
inline Eigen::Vector3f lamp_g_m(const InteractiveArea& area, const RigidTransform& T_g_c) {
    const Eigen::Vector3f below_c_m = area.origin_c_m + 0.25f * (area.axis_u_c_m + area.axis_v_c_m);
    return T_g_c * (below_c_m + 0.9f * facing_normal(area));
}

struct MirrorSphere {
    Eigen::Vector3f centre_g_m;
    float radius_m;
};

/// A virtual mesh rasterised in the pixels of a view, row-major (Fig 12 a, b). A pixel without mesh has
/// depth 0.
struct MeshPicture {
    Intrinsics intrinsics{};
    std::vector<float> depth_m;
    std::vector<float> normals_c;     ///< planes x, y, z; unit length, facing the camera
    std::vector<std::uint32_t> rgba;  ///< red in the lowest byte; alpha is not looked at
};

/// over_camera: what is virtual, opaque, and its shadows as black with alpha; to be laid over the camera's
/// own picture.
enum class ViewStyle { shaded, normals, colors, foreground, over_camera };

/// A picture of the scan that a scene wants. Wishes of one `version` want the same picture.
struct ViewWish {
    int version = 0;
    /// The view's pose; none: the camera's, and hands hide it by depth.
    std::optional<RigidTransform> T_g_v = std::nullopt;
    ViewStyle style = ViewStyle::shaded;
    bool moving = false;  ///< more wishes follow soon: half quality will do
    std::optional<MirrorSphere> sphere = std::nullopt;
    std::shared_ptr<const MeshPicture> mesh = nullptr;  ///< in the pixels of that view; may be null
    /// The mesh from the lamp (lamp_g_m), for its shadow, and the pose of that view; may be null.
    std::shared_ptr<const MeshPicture> mesh_from_light = nullptr;
    RigidTransform T_g_l = RigidTransform::Identity();
};

/// What the scene that is shown asks of the perception loop; the latest counts.
struct SceneWish {
    bool particles = false;            ///< are simulated, and kept only so long
    int particles_cleared = 0;         ///< how often they were to be cleared
    std::vector<int> pouring_fingers;  ///< of those in contact: not those on controls
    /// How far the table is tilted: of the particles' gravity, the share along the area's u and v.
    Eigen::Vector2f tilt{0.0f, 0.0f};
    std::optional<ViewWish> view = std::nullopt;
};

/// What became of a ViewWish.
struct RenderedView {
    int version = 0;  ///< of the wish
    /// Premultiplied alpha, 255 but in the style over_camera. From the camera's pose, alpha 0 where a hand is
    /// in front.
    ShadedView picture;
    bool is_full_quality = false;
    bool has_colors = false;  ///< the scan keeps colours
};

}  // namespace touchstone
