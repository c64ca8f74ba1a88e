#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/contact_means.hpp"
#include "pipeline/touch_bias.hpp"
#include "pipeline/touch_event.hpp"
#include "pipeline/types.hpp"

namespace touchstone {

struct CrossStepConfig {
    TouchBiasConfig bias;
    int rounds = 3;             ///< in which each cross is touched once
    int most_rounds = 6;        ///< where the sides were too much alike, it goes on so long
    float reach_m = 0.05f;      ///< from the cross as drawn: a touch farther away is not of it
    float most_drag_m = 0.01f;  ///< a finger that moves more while it touches is no touch of a point
};

/// "Touch the crosses": five marks on the surface, each touched from several sides, tell the bias of touches.
/// Camera frame of the area that it is given.
class CrossStep {
  public:
    /// `remark`: shown before the first touch, such as why the step begins again.
    explicit CrossStep(const CrossStepConfig& config, std::string remark = {})
        : config_(config), remark_(std::move(remark)) {}

    /// The touches of a frame, measured without bias.
    void take(std::span<const TouchEvent> touches, const InteractiveArea& area);
    CrossGuide guide(const InteractiveArea& area, const Intrinsics& intrinsics) const;
    /// Once it is over; the verdict says whether the bias may be used.
    const std::optional<TouchBiasFit>& result() const { return result_; }

  private:
    void finish(const EndedContact& contact, const InteractiveArea& area);
    int next_cross() const;
    int wanted() const;

    CrossStepConfig config_;
    ContactMeans contacts_;
    std::vector<CrossTouch> touches_;
    std::string remark_;  ///< such as why the last touch did not count
    std::optional<TouchBiasFit> result_;
    int rounds_ = 0;  ///< that were added because the sides were alike
};

/// For people: what became of the step.
std::string describe(const TouchBiasFit& fit);

}  // namespace touchstone
