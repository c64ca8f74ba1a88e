#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/connected_components.hpp"
#include "pipeline/data_association.hpp"
#include "pipeline/maps.hpp"
#include "platform/opencl/program.hpp"

namespace touchstone {

struct ForegroundSegmentationConfig {
    DataAssociationConfig association;
    ConnectedComponentsConfig components;
    float min_area_m2 = 1.5e-4f;  ///< smaller components are dropped
    int min_pixels = 40;          ///< so are these: noise is alike over some pixels, however far they are
    float min_seed_share = 0.1f;  ///< of a component's pixels that are surely in front
    /// What appears apart from the foreground of late is believed in its second frame, unless it is so many
    /// times the smallest: for a frame, the sensor puts small things where there are none.
    float sure_areas = 8.0f;
    int expect_frames = 1;          ///< what was marked in so many frames before this one is of late
    float unknown_area_m2 = 4e-3f;  ///< from where on pixels far from anything known are seeds
    float unknown_depth_m = 5.5f;   ///< and nearer than this
    float edge_jump_per_m = 0.02f;  ///< the model has an edge where depth changes by this times the depth
    int widen_px = 6;               ///< of the background's mask, at most 8
    int hold_frames = 5;            ///< the background's mask outlives the foreground by this
};

struct ForegroundComponent {
    int label = 0;
    int pixels = 0;
    PixelBox box;
    float mean_depth_m = 0.0f;
};

/// What moves in front of the background (Fig 14 b-d). Maps on the device.
struct Foreground {
    Foreground(const Device& device, const MapShape& map_shape);

    MapShape shape;
    Buffer<std::uint8_t> rejection;        ///< RejectionCode: the outlier map
    Buffer<std::uint8_t> mask;             ///< 255 on the foreground: for its reconstruction and touch
    Buffer<std::uint8_t> background_mask;  ///< of mask_background(). 255: left out of the background
    Buffer<int> labels;                    ///< label of the component, -1 = none
    std::vector<ForegroundComponent> components;
};

/// Fig 14 b-d for a fixed camera: outlier map, depth-aware components, masks.
class ForegroundSegmentation {
  public:
    ForegroundSegmentation(const Device& device, const ForegroundSegmentationConfig& config,
                           const Intrinsics& intrinsics);

    /// While scanning, when everything is background: remembers the depth of pixels where the volume has no
    /// surface (outside it, or seen too rarely), so that they do not become foreground later.
    void learn(const LiveMaps& live, const SurfacePrediction& background);
    /// Forgets what was learnt and which pixels were masked: the camera is elsewhere.
    void forget();
    /// All but the background's mask. Valid until the next call. Waits for the device.
    const Foreground& segment(const LiveMaps& live, const SurfacePrediction& background);
    /// Once after segment(), of the same frame, when nothing more urgent waits: the background's mask, which
    /// is wider than the foreground in space and time, and what was last seen outside it where the volume has
    /// no surface.
    void mask_background(const LiveMaps& live, const SurfacePrediction& background);

  private:
    void mark_candidates(const LiveMaps& live, const SurfacePrediction& background);
    void select_components(const std::vector<Component>& found);
    enum class Verdict { dropped, doubted, taken };
    Verdict judge(const Component& component) const;
    void believe_neighbours(const std::vector<Component>& found);
    void number_components(const std::vector<Component>& found, Verdict least, Buffer<std::uint8_t>& mask);
    bool is_foreground(const Component& component) const;
    float area_m2(const Component& component, int pixels) const;
    float min_area_m2(float depth_m) const;
    void launch_background_mask(const LiveMaps& live, const SurfacePrediction& background);

    ForegroundSegmentationConfig config_;
    Intrinsics intrinsics_;
    CandidateParams params_;
    DataAssociation association_;
    ConnectedComponents components_;
    Program program_;
    Kernel mark_candidates_, keep_supported_seeds_, widen_rows_, mask_background_;
    Foreground foreground_;
    Buffer<std::uint8_t> candidates_, members_, doubted_, wide_, held_;
    Buffer<float> fallback_m_;
    bool any_doubted_ = false;       ///< in doubted_; what is doubted is kept from the background, too
    std::vector<Verdict> verdicts_;  ///< of the components of this frame
    std::vector<int> numbers_;
};

}  // namespace touchstone
