#pragma once

#include <memory>
#include <optional>
#include <span>

#include "pipeline/maps.hpp"
#include "pipeline/scene_wish.hpp"
#include "pipeline/view_rendering.hpp"

namespace touchstone {

/// What a SceneView shows; all of one camera frame.
struct SceneViewFrame {
    const TsdfVolume& volume;
    const SurfacePrediction& background;  ///< from the camera's pose
    RigidTransform T_g_c = RigidTransform::Identity();
    InteractiveArea area;
    const LiveMaps& live;
    std::span<const std::uint8_t> foreground;  ///< not 0 where it is, row-major, no padding
};

/// Renders what a scene wishes to see of the scan: once for each version of its wish, at half quality while
/// that moves, then in full; and anew when the camera was moved or the picture is old. The hands of each
/// frame are cut out of a picture from the camera's pose where they are in front, and drawn into one in the
/// style `foreground`.
class SceneView {
  public:
    SceneView(const Device& device, const Intrinsics& intrinsics);

    /// `background` is lit as it is for wishes from the camera's pose. Waits for the device.
    std::shared_ptr<const RenderedView> see(const ViewWish& wish, const SceneViewFrame& frame);
    /// Pictures that were rendered so far, without those that only changed by hands.
    int renderings() const { return renderings_; }

  private:
    /// A rasterised mesh on the device.
    struct Mesh {
        Mesh(const Device& device, const MapShape& shape)
            : depth_m(device, map_pixels(shape)),
              normals_c(device, 3 * map_pixels(shape)),
              rgba(device, map_pixels(shape)) {}
        Buffer<float> depth_m, normals_c;
        Buffer<std::uint32_t> rgba;
    };

    bool is_good(const ViewWish& wish, const SceneViewFrame& frame) const;
    void render(const ViewWish& wish, const SceneViewFrame& frame);
    ViewRendering& rendering_for(const SceneViewFrame& frame);
    const MeshMaps* upload(const MeshPicture* mesh);
    const MeshShadow* upload_shadow(const ViewWish& wish);

    const Device* device_;
    Intrinsics intrinsics_;
    MapShape shape_;
    std::optional<ViewRendering> rendering_;
    Eigen::Vector3f up_g_{0.0f, 0.0f, 0.0f};  // of rendering_
    std::optional<Mesh> mesh_;
    std::optional<MeshMaps> mesh_maps_;
    std::optional<Buffer<float>> shadow_m_;
    std::optional<MeshShadow> mesh_shadow_;
    std::optional<RenderedView> shown_;  // without hands
    std::vector<float> shown_m_;         // its depth, row-major, no padding
    RigidTransform T_g_v_ = RigidTransform::Identity();
    int frames_shown_ = 0, renderings_ = 0;
};

/// Cuts what is in front out of a picture from the camera's pose: alpha 0 (and, premultiplied, black) where a
/// pixel of the foreground is nearer than `picture_m` (row-major, 0 unknown).
void cut_out_hands(const SceneViewFrame& frame, std::span<const float> picture_m, ShadedView& picture);

/// Draws the points of the foreground into a picture from T_g_v, in front of what is farther than they are by
/// `picture_m`, which takes their depth.
void draw_foreground(const SceneViewFrame& frame, const Intrinsics& intrinsics, const RigidTransform& T_g_v,
                     std::vector<float>& picture_m, ShadedView& picture);

}  // namespace touchstone
