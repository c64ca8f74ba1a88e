#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/background_model.hpp"
#include "pipeline/column_drift.hpp"
#include "pipeline/depth_map_conversion.hpp"
#include "pipeline/foreground_segmentation.hpp"
#include "pipeline/interactive_area.hpp"
#include "pipeline/rendering.hpp"
#include "pipeline/touch_detection.hpp"
#include "pipeline/types.hpp"
#include "platform/system/stage_timer.hpp"

namespace touchstone {

struct InteractionConfig {
    SensorNoise noise{0.0012f, 0.0019f, 0.4f, 0.0001f};  ///< of every stage; Kinect v1, Nguyen et al. 2012
    int scan_frames = 20;                                ///< until a still scene is live
    bool fit_area = true;                                ///< to the dominant plane; else `area`
    InteractiveArea area;
    DepthMapConversionConfig conversion;
    BackgroundConfig background;
    ForegroundSegmentationConfig segmentation;
    ColumnDriftConfig drift;
    TouchDetectionConfig touch;
    InteractiveAreaConfig area_fit;
    RenderingConfig rendering;
};

/// `noise` written into the configuration of every stage.
InteractionConfig with_shared_noise(InteractionConfig config);

enum class InteractionState { starting, scanning, live };

/// What one frame gave.
struct InteractionFrame {
    InteractionState state = InteractionState::starting;
    float scan_progress = 0.0f;  ///< 0..1
    int scan_frames_done = 0;
    std::string note;  ///< one line for the operator, empty when all is well
    std::vector<TouchEvent> touches;
    std::vector<HoverEvent> hovers;
};

/// Fig 14 for a fixed camera: scan the surroundings, then segment what moves, find touches, and follow the
/// background.
class InteractionPipeline {
  public:
    InteractionPipeline(const Device& device, const InteractionConfig& config, const Intrinsics& intrinsics);

    InteractionFrame process(const DepthView& view, std::uint64_t timestamp_us);

    /// The last frame as the camera saw it, shaded.
    ShadedView view();
    /// 0 or 255 per pixel of the last frame, row-major, no padding.
    std::vector<std::uint8_t> foreground_map() const;
    std::vector<std::uint8_t> touch_map() const;
    /// From the end of the scan on.
    const std::optional<InteractiveArea>& area() const { return area_; }
    /// Stages by the paper's names, and "frame" for all of process().
    const StageTimes& stage_times() const { return times_; }

  private:
    bool place_volume(const DepthView& view);
    void scan(InteractionFrame& frame);
    void interact(std::uint64_t timestamp_us, InteractionFrame& frame);

    const Device* device_;
    InteractionConfig config_;
    Intrinsics intrinsics_;
    MapShape shape_;
    StageTimes times_;
    DepthMapConversion conversion_;
    LiveMaps live_;
    ForegroundSegmentation segmentation_;
    ColumnDrift drift_;
    TouchDetection touch_;
    Rendering rendering_;
    std::optional<BackgroundModel> background_;
    std::optional<InteractiveArea> area_;
    Buffer<std::uint8_t> no_foreground_;
    const Buffer<std::uint8_t>* foreground_mask_;  ///< of the last frame
    int scanned_frames_ = 0;
};

}  // namespace touchstone
