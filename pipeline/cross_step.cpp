#include "pipeline/cross_step.hpp"

#include <algorithm>
#include <array>
#include <fmt/core.h>

#include "pipeline/interactive_area.hpp"
#include "pipeline/table_picture.hpp"

namespace touchstone {

using Eigen::Vector3f;

namespace {

constexpr int crosses = 5;
constexpr std::array<std::array<float, 2>, crosses> places_uv{
    {{0.5f, 0.5f}, {0.2f, 0.25f}, {0.8f, 0.25f}, {0.8f, 0.75f}, {0.2f, 0.75f}}};

Vector3f place_c_m(const InteractiveArea& area, int cross) {
    const auto& [u, v] = places_uv[static_cast<std::size_t>(cross)];
    return point_on(area, {u, v});
}

}  // namespace

int CrossStep::next_cross() const { return static_cast<int>(touches_.size()) % crosses; }

int CrossStep::wanted() const { return crosses * (config_.rounds + rounds_); }

void CrossStep::take(std::span<const TouchEvent> touches, const InteractiveArea& area) {
    for (const EndedContact& contact : contacts_.take(touches))
        if (!result_) finish(contact, area);
}

void CrossStep::finish(const EndedContact& contact, const InteractiveArea& area) {
    const int cross = next_cross();
    const TouchPlace& mean = contact.mean;
    if (contact.drag_m > config_.most_drag_m) {
        remark_ = "That finger moved: touch, hold still, lift.";
        return;
    }
    if ((mean.surface_c_m - place_c_m(area, cross)).norm() > config_.reach_m) {
        remark_ = "That was not the cross.";
        return;
    }
    remark_.clear();
    touches_.push_back({cross, mean});
    if (static_cast<int>(touches_.size()) < wanted()) return;
    const TouchBiasFit fit = fit_touch_bias(touches_, config_.bias);
    if (fit.verdict == BiasVerdict::one_sided && config_.rounds + rounds_ < config_.most_rounds)
        ++rounds_;
    else
        result_ = fit;
}

CrossGuide CrossStep::guide(const InteractiveArea& area, const Intrinsics& intrinsics) const {
    const int done = static_cast<int>(touches_.size()), round = done / crosses;
    std::string words = remark_.empty() ? "" : remark_ + " ";
    words += round == 0    ? "Touch the cross with one finger, and lift it."
             : rounds_ > 0 ? "Turn your hand much more: touch the same point of the cross from another side."
                           : "Turn your hand: touch the same point of the cross from another side.";
    return {project(intrinsics, place_c_m(area, next_cross())), done, wanted(), words};
}

std::string describe(const TouchBiasFit& fit) {
    switch (fit.verdict) {
        case BiasVerdict::good:
            return fmt::format(
                "touches move by {:.1f} mm along the finger and {:.1f} mm across, known to {:.1f} mm; "
                "touches of one cross lie {:.1f} mm apart, {:.1f} before",
                1000.0f * fit.bias.along_m, 1000.0f * fit.bias.across_m, 1000.0f * fit.sigma_m,
                1000.0f * fit.rms_m, 1000.0f * fit.rms_before_m);
        case BiasVerdict::too_few:
            return "not enough touches: touch every cross from three sides";
        case BiasVerdict::one_sided:
            return "all fingers came from one side: turn the hand between two touches of a cross";
        case BiasVerdict::scattered:
            break;
    }
    return fmt::format(
        "touches of one cross lie {:.1f} mm apart: touch the same point of the cross each time",
        1000.0f * fit.rms_m);
}

}  // namespace touchstone
