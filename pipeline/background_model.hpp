#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "pipeline/color_integration.hpp"
#include "pipeline/maps.hpp"
#include "pipeline/object_cutting.hpp"
#include "pipeline/raycasting.hpp"
#include "pipeline/resting_tiles.hpp"
#include "pipeline/sample_weights.hpp"
#include "pipeline/settled_objects.hpp"
#include "pipeline/tsdf_volume.hpp"
#include "pipeline/types.hpp"
#include "pipeline/volume_snapshot.hpp"
#include "pipeline/volumetric_integration.hpp"

namespace touchstone {

struct BackgroundConfig {
    VolumeConfig volume;
    /// A fixed camera sees a voxel always at the same depth and angle: all its samples weigh alike, and 1
    /// lets 8-bit weights average over the most frames.
    SampleWeightConfig weights{.most = 1};
    bool fit_side = true;  ///< side and place from what the first frame sees, 1 to 5 m; else volume.side_m
    float max_volume_depth_m = 4.5f;  ///< what is farther away does not widen the fitted volume
    int refresh_parts = 8;            ///< while live, each frame keeps up one of so many slices
    ColorIntegrationConfig color;
    int color_interval = 4;  ///< one frame in so many colours one of refresh_parts of the surface
    RestingTilesConfig rest;
    ObjectsConfig objects;
};

/// Where the volume lies: its side and the camera's pose in it.
struct VolumePlacement {
    float side_m = 1.0f;
    RigidTransform T_g_c = RigidTransform::Identity();
};

/// A cube parallel to the camera's axes around what a depth picture shows (0.5 to 99.5 % of the points on
/// each axis), with 10 % to spare; nothing where fewer than 1000 pixels are valid. Side 1 to 5 m, the near
/// part first where more is seen.
std::optional<VolumePlacement> fit_volume(const DepthView& view, float max_depth_m);

/// The same, with the configured side about the same middle where the side is not to be fitted.
std::optional<VolumePlacement> place_volume(const DepthView& view, const BackgroundConfig& config);

/// The fixed camera's surroundings (Fig 14a): the volume, with colours where the camera gives some, and its
/// cached prediction.
class BackgroundModel {
  public:
    BackgroundModel(const Device& device, const BackgroundConfig& config, const Intrinsics& intrinsics,
                    const VolumePlacement& placement);
    /// From a saved volume, in which the camera is at a pose. Throws Error as restore_volume.
    BackgroundModel(const Device& device, const BackgroundConfig& config, const Intrinsics& intrinsics,
                    const VolumeSnapshot& saved, const RigidTransform& T_g_c);

    /// Fuses a whole frame and predicts the whole view: while scanning.
    void scan(const LiveMaps& live);
    /// Forgets all that was fused and fuses a mean of several frames, `frames` of them at each pixel.
    void scan_anew(const LiveMaps& mean, std::span<const std::uint8_t> frames);
    /// Fuses one slice of a masked frame and refreshes what changed: while live. `rgb` may be empty: 3 bytes
    /// a pixel, row-major, registered to the depth; the surface takes its colours. Throws Error{bad_data}
    /// where it has another size.
    void follow(const LiveMaps& live, const Buffer<std::uint8_t>& mask,
                std::span<const std::uint8_t> rgb = {});
    /// The camera is elsewhere: predicts the whole view from there.
    void move_camera(const RigidTransform& T_g_c);

    /// Something was put down: from now on its surface is part of the prediction. The volume stays as it is.
    void settle(const DepthPatch& object);
    /// Things that were put down and are gone: what was there before is predicted again. Gives how many.
    int drop_taken(const ObjectFrame& frame);
    /// Moves what stood before an uncovered surface out of the volume and puts that surface there.
    VolumeSnapshot cut_out(const UncoveredSurface& uncovered, const ObjectFrame& frame);
    /// Pixels that follow() leaves out besides its mask: what was put down, and these surfaces.
    void leave_out(std::span<const UncoveredSurface> uncovered);

    const TsdfVolume& volume() const { return volume_; }
    const SettledObjects& settled() const { return settled_; }
    const SurfacePrediction& prediction() const { return prediction_; }
    const RigidTransform& T_g_c() const { return placement_.T_g_c; }

  private:
    BackgroundModel(const Device& device, const BackgroundConfig& config, const Intrinsics& intrinsics,
                    const VolumePlacement& placement, TsdfVolume volume);

    const Device* device_;
    BackgroundConfig config_;
    Intrinsics intrinsics_;
    VolumePlacement placement_;
    TsdfVolume volume_;
    SampleWeighting weighting_;
    VolumetricIntegration integration_;
    Raycasting raycasting_;
    RestingTiles resting_;
    void predict_again(const PixelRegion& box);
    const Buffer<std::uint8_t>& all_left_out(const Buffer<std::uint8_t>& mask);
    void colour(const LiveMaps& live, std::span<const std::uint8_t> rgb, const Buffer<std::uint8_t>& weights);

    SurfacePrediction prediction_;
    SettledObjects settled_;
    Program program_;
    Kernel join_masks_;
    Buffer<std::uint8_t> left_out_, joined_;
    std::optional<ColorIntegration> color_;  ///< from the first colour picture on
    int frames_to_color_ = 0, next_color_part_ = 0;
    bool leaves_out_ = false;
    int next_part_ = 0;
};

}  // namespace touchstone
