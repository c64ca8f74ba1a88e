// The pipeline on a simulated table, its foreground scored against the exact hands.
#include <algorithm>
#include <deque>
#include <fmt/core.h>
#include <set>

#include "pipeline/interaction_pipeline.hpp"
#include "platform/openni2_drivers/simulator/simulator_source.hpp"
#include "tests/accuracy/foreground_score.hpp"

namespace touchstone {

namespace {

InteractionConfig with_foreground_model() {
    InteractionConfig config;
    config.foreground.reconstruct = "on";
    return config;
}

constexpr float moving_m = 0.003f;

std::vector<float> without_padding(const Buffer<float>& map, const MapShape& shape) {
    std::vector<float> picture;
    const auto mapped = map.map_read();
    for (int y = 0; y < shape.height_px; ++y) {
        const auto row =
            mapped.values().subspan(map_index(shape, 0, y), static_cast<std::size_t>(shape.width_px));
        picture.insert(picture.end(), row.begin(), row.end());
    }
    return picture;
}

/// The first where it is, else the second.
std::vector<float> over(std::vector<float> front_m, const std::vector<float>& back_m) {
    for (std::size_t i = 0; i < front_m.size(); ++i)
        if (front_m[i] <= 0.0f) front_m[i] = back_m[i];
    return front_m;
}

class Run {
  public:
    explicit Run(const ForegroundRun& run)
        : run_(run),
          uri_(fmt::format("{}?seed={}&hands=2", run.scene, run.seed)),
          config_(parse_simulator_uri(uri_)),
          source_(config_),
          k_(source_.info().intrinsics),
          shape_(make_map_shape(k_)),
          truth_(config_),
          pipeline_(device_, with_foreground_model(), k_) {
        moments_.push_front(truth_.at(0));
    }

    ForegroundScore score() {
        SourceFrame frame;
        for (int i = 0; i < run_.frames && source_.next(frame); ++i) {
            moments_.push_front(truth_.at(i + 1));
            if (moments_.size() > LagScore::delays) moments_.pop_back();
            const InteractionFrame result = pipeline_.process({frame.depth_mm, k_}, frame.timestamp_us);
            if (result.state == InteractionState::live && moments_.size() == LagScore::delays) add_frame();
        }
        const StageSummary stage = pipeline_.stage_times().summary("foreground reconstruction");
        score_.median_ms = stage.median_ms;
        score_.p99_ms = stage.p99_ms;
        score_.frame_median_ms = pipeline_.stage_times().summary("frame").median_ms;
        score_.modelled_share = modelled_ / std::max(foreground_, 1.0);
        score_.volumes_made = static_cast<int>(ids_.size());
        return score_;
    }

  private:
    void add_frame() {
        const ForegroundModel& model = *pipeline_.foreground_model();
        raw_m_ = without_padding(pipeline_.live().depth_m, shape_);
        filtered_m_ = without_padding(pipeline_.live().filtered_m, shape_);
        shown_m_ = without_padding(model.surface().depth_m, shape_);
        const Mapped sources = model.source().map_read();
        for (const std::uint8_t source : sources.values()) {
            foreground_ += source != FOREGROUND_NONE ? 1.0 : 0.0;
            modelled_ += source == FOREGROUND_MODEL ? 1.0 : 0.0;
        }
        for (const MovingVolume& volume : model.volumes()) ids_.insert(volume.id());
        for (int hand = 0; hand < config_.hands; ++hand) add_hand(hand);
    }

    void add_hand(int hand) {
        const auto at = static_cast<std::size_t>(hand);
        const HandTruth::Moment &now = moments_[1], &before = moments_[2];
        if (!now.hands[at]) return;
        if (!before.hands[at]) ++score_.hand_visits;
        const float step_m = hand_step_m(before.hands[at], now.hands[at]);
        const bool moves = step_m >= moving_m;
        add_errors(arm_parts(hand, *now.hands[at]), moves ? score_.moving_arms : score_.still_arms);
        add_errors(parts_before_the_arm(hand, *now.hands[at]),
                   moves ? score_.moving_hands : score_.still_hands);
        if (!moves) return;
        add_lag(hand);
    }

    void add_errors(const HandParts& parts, ForegroundScore::Errors& errors) {
        const std::array surfaces{ScoredSurface{raw_m_, &errors.raw},
                                  ScoredSurface{filtered_m_, &errors.filtered},
                                  ScoredSurface{shown_m_, &errors.shown}};
        add_surface_errors(k_, moments_[1].picture, parts, surfaces);
    }

    void add_lag(int hand) {
        const auto at = static_cast<std::size_t>(hand);
        const sim::Vec3 tip_c = truth_.view().to_camera(moments_[1].hands[at]->index().a);
        const sim::Vec3 before_c = truth_.view().to_camera(moments_[2].hands[at]->index().a);
        if ((tip_c - before_c).norm() < moving_m || tip_c.z() <= 0.1f) return;
        std::vector<const sim::Picture*> truths;
        for (const HandTruth::Moment& moment : moments_) truths.push_back(&moment.picture);
        const std::vector<float> background_m =
            without_padding(pipeline_.background()->prediction().depth_m, shape_);
        const Eigen::Vector2f tip_px = truth_.view().project(tip_c);
        score_.raw_lag.add(k_, raw_m_, truths, tip_px);
        score_.shown_lag.add(k_, over(shown_m_, background_m), truths, tip_px);
        std::vector<float> model_m = background_m;
        for (const MovingVolume& volume : pipeline_.foreground_model()->volumes())
            model_m = over(without_padding(volume.prediction.depth_m, shape_), model_m);
        score_.model_lag.add(k_, model_m, truths, tip_px);
    }

    ForegroundRun run_;
    std::string uri_;
    SimulatorConfig config_;
    SimulatorSource source_;
    Intrinsics k_;
    MapShape shape_;
    HandTruth truth_;
    Device device_{DeviceConfig{}};
    InteractionPipeline pipeline_;
    std::deque<HandTruth::Moment> moments_;  ///< the next frame's, this one's, those before it
    std::vector<float> raw_m_, filtered_m_, shown_m_;
    double foreground_ = 0.0, modelled_ = 0.0;
    std::set<int> ids_;
    ForegroundScore score_;
};

}  // namespace

ForegroundScore score_foreground(const ForegroundRun& run) { return Run(run).score(); }

}  // namespace touchstone
