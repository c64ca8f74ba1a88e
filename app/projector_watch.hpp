#pragma once

#include <memory>
#include <optional>

#include "app/projector_calibration.hpp"
#include "pipeline/projector_squares.hpp"

namespace touchstone {

/// A look where a calibrated projector's light falls, frame by frame; under two seconds of frames.
class ProjectorWatch {
  public:
    /// `model` of the scan's frame, for the size of the display that shows it.
    ProjectorWatch(const ProjectorModel& model, const TableLook& look, float limit_mm);

    /// To be thrown from now on.
    const std::shared_ptr<const ThrownPicture>& picture() const { return picture_; }
    /// The frame after that picture was shown, or one more of it; passed over where it has no colours. The
    /// table is undisturbed.
    void take(const TableLook& look);
    /// The colour camera has seen white: its exposure is to stay as it is.
    bool wants_held_exposure() const { return exposed_ >= exposure_frames && !result_; }
    const std::optional<ProjectorCheck>& result() const { return result_; }

  private:
    static constexpr int exposure_frames = 12;

    void show(int pattern);
    void conclude(const TableLook& look);

    ProjectorModel model_;
    float limit_mm_;
    ProjectorSquares squares_;
    PatternSession session_;
    int exposed_ = 0, shown_ = -1;
    std::shared_ptr<const ThrownPicture> picture_;
    std::optional<ProjectorCheck> result_;
};

}  // namespace touchstone
