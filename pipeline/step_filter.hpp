#pragma once

#include "pipeline/pose_solver.hpp"

namespace touchstone {

struct StepFilterConfig {
    /// Squared length of a step in units of its noise, 6 on average where the camera is still: below
    /// `mean_limit` over the last frames and `limit` in this one, the camera stays.
    double mean_limit = 15.0, limit = 35.0;
    double gain = 0.1;  ///< of the averages: 1 / time constant in frames
};

/// A camera that is still stays where it is, instead of following the noise of each frame: its model would be
/// fused along, and what is a bias of some hundredths of a millimetre would add up. Steps are compared with
/// their own noise, as the residuals of the frame have it. A step that is held is not lost: the next one is
/// against the same model, so that slow movement adds up until it stands out, and is followed with the part
/// of the step that noise does not explain (James and Stein's shrinkage).
class StepFilter {
  public:
    explicit StepFilter(const StepFilterConfig& config) : config_(config) {}

    /// What is believed of the step T_p_c from the prediction's pose, which must be one that was believed:
    /// the last, or that of some frames before.
    RigidTransform believed(const RigidTransform& T_p_c, const StepEvidence& evidence);
    /// After a jump of the pose.
    void restart();

  private:
    StepFilterConfig config_;
    StepEvidence average_;
    double squared_sigmas_ = 0.0;
    int frames_ = 0;
};

}  // namespace touchstone
