#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "app/area_keeper.hpp"
#include "app/camera_recovery.hpp"
#include "app/command_line.hpp"
#include "app/fault_reports.hpp"
#include "app/frame_health.hpp"
#include "app/frame_outputs.hpp"
#include "app/health.hpp"
#include "app/operator_desk.hpp"
#include "app/projector_desk.hpp"
#include "app/touch_outputs.hpp"
#include "app/unsaved.hpp"
#include "pipeline/cross_step.hpp"
#include "pipeline/interaction_pipeline.hpp"
#include "pipeline/particle_table.hpp"
#include "pipeline/scene_view.hpp"
#include "platform/camera/depth_camera.hpp"
#include "platform/camera/sensor_session.hpp"
#include "ui/table_frame.hpp"

namespace touchstone {

/// What the screen's side asks of the perception loop; the latest counts.
struct TableWish {
    SceneWish scene;
    OperatorWish operating;
    ProjectorScreen projecting;
};

/// The perception loop: camera frame -> pipeline -> touches -> sinks. Never waits for the screen.
class Perception {
  public:
    /// Opens the compute device, the sensor (when one is named) and the sinks; throws Error.
    explicit Perception(const RunOptions& options);
    /// Says what the stages took, at log level debug.
    ~Perception();

    /// The next result: one processed frame, or word that there is no camera. Nothing once the source or the
    /// wanted number of frames is at its end.
    std::optional<TableFrame> step();
    /// What the last result leaves to be done once it is handed on: the background follows. Else step() does
    /// it first.
    void follow();
    /// What scene and operator need from now on.
    void take(TableWish wish);
    const HealthFigures& figures() const { return health_.figures(); }
    /// In step pace every frame must be shown before the next one.
    bool in_lock_step() const { return camera_ && camera_->pace() == Pace::step; }

  private:
    std::optional<TableFrame> next();
    std::optional<TableFrame> wait_for_camera();
    void open_camera();
    /// What is wrong with a picture of a camera that only seems to live; nothing when it is good. Puts its
    /// time right.
    std::optional<CameraFault> fault_of(DepthFrame& frame);
    TableFrame without_good_frame(const CameraFault& fault);
    void help_camera(const CameraFault& fault);
    TableFrame without_camera(const std::string& reason);
    void drop_camera();
    /// The camera gives nothing: no touch outlives that.
    void release_touches();
    void show_light(const std::string& state);
    TableFrame process(const DepthFrame& frame);
    TableFrame without_frame(const std::string& state, const std::string& note);
    void publish(const InteractionFrame& result, const DepthFrame& frame);
    void start_pipeline(const Intrinsics& intrinsics);
    /// Writes something; that it fails is said, with what it means otherwise, in the log and to the operator.
    /// True where it went well.
    bool keep(const std::string& what, const std::string& otherwise, const std::function<void()>& write);
    /// Counts it, and keeps it for the operator. True where it is news.
    bool note_unsaved(const std::string& what, const std::string& reason);
    /// What others write, and log; no reason where it went well.
    void take_unsaved(const std::string& what, const std::string& reason);
    /// A scan that cannot be written is tried again once a minute.
    void save_scan_when_new(InteractionState state);
    /// The scan of an object to follow: one that is damaged is not followed.
    void load_object();
    /// Takes the bias of touches from its file, or begins to ask for it.
    void prepare_touch_bias();
    /// Whether crosses are to be touched; their touches are no others'.
    bool calibrates(InteractionState state) const {
        return projector_.calibrates() || (crosses_ && state == InteractionState::live);
    }
    bool asks_for_crosses(InteractionState state) const {
        return crosses_ && !projector_.calibrates() && state == InteractionState::live;
    }
    void take_crosses(const InteractionFrame& result);
    void follow_projector(const InteractionFrame& result, const DepthFrame& frame, TableFrame& shown);
    void calibrate_projector();
    /// Colours are watched and exposure is held only while the projector needs it.
    void watch_projector();
    /// Particles and pictures, as the scene wishes.
    void serve_scene(const InteractionFrame& result, std::uint64_t timestamp_us, TableFrame& shown);
    std::shared_ptr<const ParticleView> move_particles(const InteractionFrame& result,
                                                       std::uint64_t timestamp_us);
    std::shared_ptr<const RenderedView> render_wish();
    void measure_rate(std::chrono::steady_clock::time_point start);
    /// Counts it, and keeps it for the operator.
    void note_fault(const std::string& word, const std::string& reason);
    void scan_anew();
    /// Asks for the crosses.
    void calibrate_touches();
    void change_areas(std::span<const AreaDraft> drafts);
    void record_soon();
    void end_recording_when_due();
    std::shared_ptr<const OperatorView> operator_view() const;

    RunOptions options_;
    Device device_;
    SensorSession session_;  ///< for the whole life: loading OpenNI2 anew is slow and loses memory
    std::optional<DepthCamera> camera_;
    CameraRecovery recovery_;
    FrameJudge judge_;
    SteadyTime time_;
    Health health_;
    std::optional<FaultReports> fault_reports_;
    std::string light_state_;
    std::unique_ptr<InteractionPipeline> pipeline_;
    std::optional<VolumeSnapshot> object_;  ///< that is followed in hands
    AreaKeeper areas_;
    TouchOutputs outputs_;
    std::optional<PictureFolder> maps_;
    std::optional<CrossStep> crosses_;  ///< until they told the bias of touches
    TouchBias bias_;
    SceneWish wish_;
    OperatorDesk desk_;
    bool ignores_saved_scan_ = false;
    std::optional<ParticleTable> particles_;  ///< while the scene wishes them
    std::optional<SceneView> scene_view_;     ///< while the scene wishes a picture
    int particles_cleared_ = 0;               ///< as often as the scene wished
    ProjectorDesk projector_;
    StageTimes scene_times_;
    Intrinsics intrinsics_{};
    std::chrono::steady_clock::time_point last_frame_{};
    float rate_hz_ = 0.0f;
    int frames_done_ = 0;
    TableFrame last_shown_;
    std::optional<InteractionState> to_follow_;  ///< of a frame that was seen only
    std::vector<std::uint8_t> color_to_follow_;  ///< of that frame; may be empty
    bool scan_is_new_ = false;                   ///< made or moved since it was last written
    std::chrono::steady_clock::time_point next_scan_save_{};
    Unsaved unsaved_;
};

/// For the mailbox: the newer frame, with the touch events of the one that was never drawn put before its
/// own.
TableFrame merge_frames(TableFrame&& untaken, TableFrame&& newer);

}  // namespace touchstone
