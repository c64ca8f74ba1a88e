#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pipeline/background_model.hpp"
#include "pipeline/camera_watch.hpp"
#include "pipeline/column_drift.hpp"
#include "pipeline/depth_map_conversion.hpp"
#include "pipeline/foreground_model.hpp"
#include "pipeline/foreground_segmentation.hpp"
#include "pipeline/held_object.hpp"
#include "pipeline/interactive_area.hpp"
#include "pipeline/object_segmentation.hpp"
#include "pipeline/realignment.hpp"
#include "pipeline/rendering.hpp"
#include "pipeline/scan_file.hpp"
#include "pipeline/scan_stillness.hpp"
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
    ScanStillnessConfig stillness;
    BackgroundConfig background;
    ForegroundSegmentationConfig segmentation;
    ColumnDriftConfig drift;
    TouchDetectionConfig touch;
    InteractiveAreaConfig area_fit;
    RenderingConfig rendering;
    ForegroundModelConfig foreground;
    HeldObjectConfig held;
    bool follow_lifted = false;  ///< what was last lifted out of the scan is looked for in hands
    CameraWatchConfig watch;
    RealignmentConfig realignment;
    int saved_scan_frames = 60;  ///< in which a saved scan must be found to fit
};

/// `noise` written into the configuration of every stage.
InteractionConfig with_shared_noise(InteractionConfig config);

/// Starting: nothing seen yet, or a saved scan is compared with the view. Realigning: the camera was moved,
/// and touches are frozen until its pose is known again.
enum class InteractionState { starting, scanning, live, realigning };

/// What one frame gave.
struct InteractionFrame {
    InteractionState state = InteractionState::starting;
    float scan_progress = 0.0f;  ///< 0..1
    int scan_frames_done = 0;
    std::string note;  ///< one line for the operator, empty when all is well
    std::vector<TouchEvent> touches;
    std::vector<HoverEvent> hovers;
    ObjectChanges objects;                ///< put down, taken away, lifted out of the scan
    std::optional<HeldObjectFrame> held;  ///< while an object is looked for; only of live frames
};

/// Fig 14 for a fixed camera: scan the surroundings, then segment what moves, find touches, and follow the
/// background. A camera that was knocked is put right.
class InteractionPipeline {
  public:
    InteractionPipeline(const Device& device, const InteractionConfig& config, const Intrinsics& intrinsics);

    /// Before the first frame: no new scan when the view fits this one. Throws Error as restore_volume.
    void use_scan(const SavedScan& scan);
    /// From now on this object is looked for in the foreground, and followed (Fig 1 E). Throws Error as
    /// restore_volume.
    void follow_object(const VolumeSnapshot& model);
    /// The camera is lost: all touches end. The next frame says so.
    void release_touches();
    /// Is taken off the places of touches from the next frame on.
    void set_touch_bias(const TouchBias& bias) { touch_.set_bias(bias); }
    /// What a frame shows, its touches above all. follow() must come before the next frame.
    InteractionFrame see(const DepthView& view, std::uint64_t timestamp_us);
    /// Keeps the background up with the frame that was seen last: it can wait until the touches are out.
    /// `rgb`, its colours, may be empty; as BackgroundModel::follow.
    void follow(std::span<const std::uint8_t> rgb = {});
    /// Both.
    InteractionFrame process(const DepthView& view, std::uint64_t timestamp_us);
    /// The background as it is. Only once the state has been live. Waits for the device.
    SavedScan saved_scan() const;

    /// The last frame as the camera saw it, shaded.
    ShadedView view();
    /// 0 or 255 per pixel of the last frame, row-major, no padding.
    std::vector<std::uint8_t> foreground_map() const;
    std::vector<std::uint8_t> touch_map() const;
    /// From the end of the scan on.
    const std::optional<InteractiveArea>& area() const { return area_; }
    /// Null until something was seen.
    const BackgroundModel* background() const { return background_ ? &*background_ : nullptr; }
    const CameraWatch& watch() const { return watch_; }
    /// Fig 14e; null where foreground.reconstruct is off.
    const ForegroundModel* foreground_model() const {
        return foreground_model_ ? &*foreground_model_ : nullptr;
    }
    /// As measured, of the last frame; normals from follow() on.
    const LiveMaps& live() const { return live_; }
    /// Stages by the paper's names; "touches out" is all of see(), "frame" that and follow().
    const StageTimes& stage_times() const { return times_; }
    void forget_stage_times() { times_.clear(); }

  private:
    bool normals_can_wait() const;
    void find_normals();
    bool place_volume(const DepthView& view);
    void scan(const DepthView& view, InteractionFrame& frame);
    bool waits_for_stillness(InteractionFrame& frame);
    void keep_what_is_still();
    void fit_area();
    void interact(std::uint64_t timestamp_us, InteractionFrame& frame);
    void reconstruct_foreground(const Foreground& foreground);
    void find_held_object(const Foreground& foreground, InteractionFrame& frame);
    void detect_touches(const Foreground& foreground, std::uint64_t timestamp_us, InteractionFrame& frame);
    void follow_sensor(const Foreground& foreground);
    void segment_objects(const Foreground& foreground, std::uint64_t timestamp_us, InteractionFrame& frame);
    CameraVerdict judge_camera(const Foreground& foreground);
    void begin_realigning(InteractionFrame& frame);
    void align(const DepthView& view, InteractionFrame& frame);
    void take_pose(const RigidTransform& T_g_c);
    void scan_anew();

    const Device* device_;
    InteractionConfig config_;
    Intrinsics intrinsics_;
    MapShape shape_;
    StageTimes times_;
    DepthMapConversion conversion_;
    LiveMaps live_;
    bool has_normals_ = false;  ///< live_, of the last frame
    ScanStillness stillness_;
    ForegroundSegmentation segmentation_;
    ColumnDrift drift_;
    TouchDetection touch_;
    std::vector<TouchEvent> released_;  // when the camera was lost
    ObjectSegmentation objects_;
    Rendering rendering_;
    std::optional<ForegroundModel> foreground_model_;
    std::optional<HeldObject> held_;
    bool foreground_is_modelled_ = false;    ///< in the last frame
    const Foreground* to_follow_ = nullptr;  ///< of a frame that follow() has to look at; else null
    bool pose_is_sure_ = false;              ///< in that frame: the background may follow
    std::optional<BackgroundModel> background_;
    std::optional<InteractiveArea> area_;
    Buffer<std::uint8_t> no_foreground_;
    const Buffer<std::uint8_t>* foreground_mask_;  ///< of the last frame
    int scanned_frames_ = 0, waited_frames_ = 0;
    CameraWatch watch_;
    Realignment realignment_, start_alignment_;
    Realignment* aligning_ = nullptr;        ///< the one that looks for the camera's pose
    std::vector<float> shift_before_doubt_;  ///< of the columns
    KeyframeDatabase keyframes_;
    std::string scan_reason_;  ///< why there is a new scan
};

}  // namespace touchstone
