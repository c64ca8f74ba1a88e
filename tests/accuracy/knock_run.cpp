#include "tests/accuracy/knock_run.hpp"

#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <set>

#include "pipeline/realignment.hpp"
#include "platform/openni2_drivers/simulator/knock.hpp"
#include "platform/openni2_drivers/simulator/simulator_source.hpp"

namespace touchstone {

namespace {

SimulatorConfig simulation(const KnockRun& run) {
    return parse_simulator_uri(
        fmt::format("{}?seed={}&hands={}&knock_s={}&knock_deg={}&knock_mm={}", run.scene, run.seed, run.hands,
                    (static_cast<double>(run.knock_frame) - 0.5) / 30.0, run.knock_deg, run.knock_mm));
}

/// Books what each frame says.
class Ledger {
  public:
    Ledger(const KnockRun& run, KnockScore& score) : run_(run), score_(score) {}

    void add(int frame, const InteractionFrame& result) {
        const bool live = result.state == InteractionState::live;
        const int since = frame - run_.knock_frame;
        if (since >= 0 && !live && !score_.frames_to_notice) score_.frames_to_notice = since;
        if (live && score_.frames_to_notice && !score_.frames_to_live && score_.scans_anew == 0)
            score_.frames_to_live = since;
        const bool alarmed = was_live_ && result.state == InteractionState::realigning;
        if (alarmed && (since < 0 || ++alarms_ > 1)) ++score_.false_alarms;
        if (!was_scanning_ && frame > 0 && result.state == InteractionState::scanning) ++score_.scans_anew;
        was_live_ = live;
        was_scanning_ = result.state == InteractionState::scanning;
        for (const TouchEvent& touch : result.touches) {
            if (touch.phase == TouchPhase::up) down_.erase(touch.tip.id);
            if (touch.phase == TouchPhase::down) down_.insert(touch.tip.id);
            if (!live && touch.phase != TouchPhase::up) ++score_.frozen_reports;
            if (live && since >= 0 && !score_.frames_to_notice && touch.phase == TouchPhase::down)
                ++score_.early_downs;
        }
        if (live) return;
        score_.frozen_reports += static_cast<int>(result.hovers.size());
        score_.open_touches += static_cast<int>(down_.size());
    }

  private:
    KnockRun run_;
    KnockScore& score_;
    std::set<int> down_;
    bool was_live_ = false, was_scanning_ = true;
    int alarms_ = 0;
};

}  // namespace

PoseError pose_error(const RigidTransform& T_true, const RigidTransform& T_found,
                     const SurfacePrediction& prediction, const Intrinsics& k) {
    const RigidTransform off = T_true.inverse() * T_found;
    const Displacement step = displacement(off);
    const auto depth_m = prediction.depth_m.read();
    std::vector<float> gaps_mm;
    for (int y = 0; y < k.height_px; y += 4) {
        for (int x = 0; x < k.width_px; x += 4) {
            const std::size_t at = map_index(prediction.shape, x, y);
            if (depth_m[at] <= 0.0f) continue;
            const Eigen::Vector3f p_c =
                depth_m[at] * Eigen::Vector3f((static_cast<float>(x) - k.cx_px) / k.fx_px,
                                              (static_cast<float>(y) - k.cy_px) / k.fy_px, 1.0f);
            const Eigen::Vector3f moved_c = off * p_c;
            const auto u = static_cast<int>(std::lround(moved_c.x() / moved_c.z() * k.fx_px + k.cx_px));
            const auto v = static_cast<int>(std::lround(moved_c.y() / moved_c.z() * k.fy_px + k.cy_px));
            if (u < 0 || v < 0 || u >= k.width_px || v >= k.height_px) continue;
            const float there_m = depth_m[map_index(prediction.shape, u, v)];
            if (there_m > 0.0f) gaps_mm.push_back(1000.0f * std::abs(moved_c.z() - there_m));
        }
    }
    if (gaps_mm.empty()) return {1000.0f * step.shift_m, step.turn_deg, 0.0f};
    const auto most = gaps_mm.begin() + static_cast<std::ptrdiff_t>(9 * gaps_mm.size() / 10);
    std::ranges::nth_element(gaps_mm, most);
    return {1000.0f * step.shift_m, step.turn_deg, *most};
}

KnockScore run_knock(const Device& device, const KnockRun& run, const InteractionConfig& config) {
    const SimulatorConfig simulated = simulation(run);
    SimulatorSource source(simulated);
    const Intrinsics k = source.info().intrinsics;
    InteractionPipeline pipeline(device, config, k);
    KnockScore score;
    Ledger ledger(run, score);
    SourceFrame picture;
    RigidTransform T_g_before = RigidTransform::Identity();
    for (int frame = 0; frame < run.frames && source.next(picture); ++frame) {
        if (frame == run.knock_frame) T_g_before = pipeline.background()->T_g_c();
        const auto start = std::chrono::steady_clock::now();
        const InteractionFrame result = pipeline.process({picture.depth_mm, k}, picture.timestamp_us);
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
        if (result.state == InteractionState::realigning)
            score.slowest_ms = std::max(score.slowest_ms, took.count());
        ledger.add(frame, result);
    }
    const RigidTransform T_true(sim::knock(simulated, 1e9).cast<float>());
    score.error = pose_error(T_true, T_g_before.inverse() * pipeline.background()->T_g_c(),
                             pipeline.background()->prediction(), k);
    score.mean_watch_ms = pipeline.stage_times().summary("camera watch").median_ms;
    return score;
}

}  // namespace touchstone
