#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "app/command_line.hpp"
#include "pipeline/gray_code.hpp"
#include "pipeline/interaction_pipeline.hpp"
#include "pipeline/pattern_session.hpp"
#include "pipeline/projector_crosses.hpp"
#include "pipeline/projector_fit.hpp"
#include "platform/camera/depth_frame.hpp"
#include "platform/display/picture.hpp"
#include "ui/thrown_picture.hpp"

namespace touchstone {

/// What a calibration of the projector found.
struct CalibrationResult {
    std::string method;  ///< touch or graycode
    ProjectorFit fit;
    std::string verdict;  ///< in words: how good, or what was seen and what to change
};

/// One processed frame of the table whose projector is looked at.
struct TableLook {
    const InteractionFrame& seen;
    const InteractionPipeline& pipeline;
    const DepthFrame& frame;

    /// Somebody is over the table, or its camera is not at rest.
    bool is_disturbed() const;
    /// Of the scan's frame, once the table is live.
    InteractiveArea area_g() const;
    /// Of each pixel of the camera: x, y, z of the scan's frame, 1; all 0 where there is none.
    std::vector<Eigen::Vector4f> points_g_m() const;
};

struct ProjectorCalibrationConfig {
    int quiet_frames = 45;     ///< live, undisturbed: until the model's points are good to about a millimetre
    int exposure_frames = 20;  ///< in which the colour camera gets used to white
    int patience_frames = 0;   ///< for the table to be quiet; 0: for ever
};

/// The stages of a calibration before its crosses: waiting for the table to be quiet, for the camera to be
/// used to white, and the stripes.
struct QuietStage {
    int quiet = 0, frames = 0;
};
struct ExposureStage {
    int frames = 0;
};
struct StripesStage {
    GrayCode code;
    PatternSession session;
    int shown = -1;
};

/// The calibration of a projector, frame by frame: what it is to throw, and what the camera saw of it. By
/// light, stripes are shown; by touch, crosses.
class ProjectorCalibration {
  public:
    ProjectorCalibration(CalibrationMethod method, PixelSize projector_px,
                         const ProjectorCalibrationConfig& config = {});

    /// To be thrown from now on.
    const std::shared_ptr<const ThrownPicture>& picture() const { return picture_; }
    /// The frame after that picture was shown, or one more of it. By light it has colours, or is passed over.
    /// Throws Error{bad_data} where something disturbs for ever.
    void take(const TableLook& look);
    /// Frames come with colours from now on.
    bool wants_color() const { return method_ == CalibrationMethod::graycode && !result_; }
    /// The colour camera has seen white: its exposure is to stay as it is.
    bool wants_held_exposure() const { return wants_color() && std::holds_alternative<StripesStage>(stage_); }
    /// Once it is over; for points of the scan's frame.
    const std::optional<CalibrationResult>& result() const { return result_; }
    /// How far it is, for people.
    const std::string& progress() const { return progress_; }

  private:
    void take_in(QuietStage& quiet, const TableLook& look);
    void take_in(ExposureStage& exposure, const TableLook& look);
    void take_in(StripesStage& stripes, const TableLook& look);
    void take_in(ProjectorCrosses& crosses, const TableLook& look);
    void begin(const TableLook& look);
    void show(const StripesStage& stripes);
    void show(const ProjectorCrosses& crosses);
    void show_words(const std::string& words);
    void conclude(const StripesStage& stripes, const TableLook& look);
    void conclude(const ProjectorCrosses& crosses, const TableLook& look);

    CalibrationMethod method_;
    PixelSize projector_px_;
    ProjectorCalibrationConfig config_;
    std::variant<QuietStage, ExposureStage, StripesStage, ProjectorCrosses> stage_;
    std::shared_ptr<const ThrownPicture> picture_ = std::make_shared<ThrownPicture>();
    std::optional<CalibrationResult> result_;
    std::string progress_;
};

}  // namespace touchstone
