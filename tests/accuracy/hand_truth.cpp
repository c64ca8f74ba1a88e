#include "tests/accuracy/hand_truth.hpp"

#include <algorithm>

#include "platform/openni2_drivers/simulator/static_layer.hpp"

namespace touchstone {

namespace {

constexpr float middle_row_px = 239.5f, last_column_px = 639.0f;

}  // namespace

HandTruth::HandTruth(const SimulatorConfig& config)
    : config_(config),
      view_(sim::make_table_view(config.height_m, config.tilt_deg)),
      scene_(sim::make_scene(config.scene, config.seed, view_.on_table(last_column_px, middle_row_px).x())),
      static_depth_m_(sim::render_static_depth(scene_, view_)) {
    for (int hand = 0; hand < config.hands; ++hand) {
        const float half = config.hands < 2 ? 0.0f : hand == 0 ? -1.0f : 1.0f;
        scripts_.emplace_back(config_, sim::Workplace{scene_, view_, static_depth_m_, half}, hand);
    }
}

HandTruth::Moment HandTruth::at(int frame) {
    Moment moment;
    sim::clear_picture(moment.picture, static_depth_m_);
    for (std::size_t i = 0; i < scripts_.size(); ++i) {
        const std::optional<sim::HandMoment> hand = scripts_[i].at(frame / config_.rate_hz);
        if (!hand) continue;
        moment.hands[i] = hand->hand;
        sim::draw_hand(moment.picture, hand->hand, static_cast<int>(i), view_);
    }
    return moment;
}

float hand_step_m(const std::optional<sim::Hand>& before, const std::optional<sim::Hand>& now) {
    if (!before || !now) return 0.0f;
    const std::size_t count = std::min(before->parts.size(), now->parts.size());
    float sum_m = 0.0f;
    for (std::size_t i = 0; i < count; ++i) sum_m += (now->parts[i].cone.a - before->parts[i].cone.a).norm();
    return count > 0 ? sum_m / static_cast<float>(count) : 0.0f;
}

}  // namespace touchstone
