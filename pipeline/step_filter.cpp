#include "pipeline/step_filter.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace touchstone {

void StepFilter::restart() {
    squared_sigmas_ = 0.0;
    frames_ = 0;
}

RigidTransform StepFilter::believed(const RigidTransform& T_p_c, const StepEvidence& evidence) {
    // The mean of the first frames, then one that forgets.
    const double gain = std::max(config_.gain, 1.0 / ++frames_);
    average_.A += gain * (evidence.A - average_.A);
    average_.scatter += gain * (evidence.scatter - average_.scatter);
    const Vector6d step = twist_of(T_p_c, evidence.centre_m);
    // The covariance of the step is A^-1 scatter A^-1.
    const Vector6d pull = average_.A * step;
    const double now = std::max(pull.dot(average_.scatter.ldlt().solve(pull)), 0.0);
    squared_sigmas_ += gain * (now - squared_sigmas_);
    const double share =
        std::max({0.0, 1.0 - config_.mean_limit / squared_sigmas_, 1.0 - config_.limit / now});
    return twist_about(share * step, evidence.centre_m);
}

}  // namespace touchstone
