#pragma once

#include <span>
#include <string>
#include <vector>

#include "pipeline/camera_tracking.hpp"
#include "pipeline/foreground_assignment.hpp"
#include "pipeline/raycasting.hpp"
#include "pipeline/sample_weights.hpp"

namespace touchstone {

struct ForegroundModelConfig {
    /// "on", "off", or "auto": on where the device is no CPU, for which it takes too much of a frame yet.
    std::string reconstruct = "auto";
    int most_volumes = 3;      ///< more components are shown as they are measured
    int min_pixels = 500;      ///< smaller components, too
    int missing_frames = 5;    ///< a volume outlives its component by this
    float reach_m = 0.15f;     ///< a component that no volume covers is a volume's within this distance
    float gate_sigmas = 3.0f;  ///< a prediction farther from the live depth is not shown
    VolumeConfig volume{192, 0.768f, 3.0f, 2.5f, 0.0f, 128, 3000};
    AdaptiveWeightParams adaptive{0.5f, 0.3f, 1.2f, 1};
    SampleWeightConfig weights;
    CameraTrackingConfig tracking{.levels = {TrackingLevel{3, 0.02f, 4.0f}, TrackingLevel{4, 0.04f, 8.0f},
                                             TrackingLevel{5, 0.10f, 30.0f}}};
};

/// Whether the configuration asks for it on this device. Throws Error{configuration} for another word.
bool reconstructs_foreground(const ForegroundModelConfig& config, const Device& device);

/// Fig 14e, 15, 16: each large component of the foreground has a small volume that moves with it.
class ForegroundModel {
  public:
    ForegroundModel(const Device& device, const ForegroundModelConfig& config, const Intrinsics& intrinsics);

    /// Tracks, fuses and predicts. The foreground's surface in the camera frame on the mask of this frame;
    /// where no volume predicts it, or the live depth contradicts, it is the live surface. Valid until the
    /// next call.
    const SurfacePrediction& update(const LiveMaps& live, const Foreground& foreground);
    /// Drops all volumes.
    void forget();

    const SurfacePrediction& surface() const { return surface_; }
    /// ForegroundSource of each pixel of the surface.
    const Buffer<std::uint8_t>& source() const { return source_; }
    std::span<const MovingVolume> volumes() const { return volumes_; }

  private:
    struct Part {
        ForegroundComponent component;
        ComponentPoints points;
        PixelRegion region;  ///< of the component, with a margin
    };

    std::vector<Part> large_parts(const LiveMaps& live, const Foreground& foreground) const;
    void assign(std::span<const Part> parts, std::vector<int>& component_of);
    void follow(MovingVolume& volume, const Part& part, const LiveMaps& live, const Foreground& foreground);
    void track(MovingVolume& volume, const Part& part, const LiveMaps& live);
    void take_prediction(const MovingVolume& volume, const Part& part, const LiveMaps& live,
                         const Foreground& foreground);

    const Device* device_;
    ForegroundModelConfig config_;
    Intrinsics intrinsics_;
    MapShape shape_;
    SampleWeighting weighting_;
    CameraTracking tracking_;
    VolumetricIntegration integration_;
    Raycasting raycasting_;
    Program program_;
    Kernel pick_component_, drop_component_, no_prediction_, take_live_, take_prediction_;
    /// 0, 0 and 255, except where a volume is being followed.
    Buffer<std::uint8_t> own_weights_, weights_with_free_, others_;
    Buffer<std::uint8_t> source_;
    SurfacePrediction surface_;
    std::vector<MovingVolume> volumes_;
    const Buffer<std::uint8_t>* sample_weights_ = nullptr;  ///< of this frame
    int next_id_ = 0;
};

}  // namespace touchstone
