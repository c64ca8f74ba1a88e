#include "tests/accuracy/recovery_run.hpp"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/support/watched_program.hpp"

namespace touchstone {

namespace {

using Clock = std::chrono::steady_clock;

/// Touches of one frame after the other.
class TouchWatch {
  public:
    explicit TouchWatch(RecoveryScore& score) : score_(&score) {}

    void take(const nlohmann::json& line) {
        std::set<int> listed;
        for (const auto& touch : line["touches"]) {
            const int id = touch["id"].get<int>();
            const bool was_down = down_.contains(id), goes_down = touch["phase"] == "down";
            listed.insert(id);
            score_->downs += goes_down;
            score_->confused_events += was_down == goes_down;
            if (goes_down) down_.insert(id);
            if (touch["phase"] == "up") down_.erase(id);
        }
        const auto is_left = [&](int id) { return !listed.contains(id); };
        score_->left_touches += static_cast<int>(std::ranges::count_if(down_, is_left));
        std::erase_if(down_, is_left);
    }

  private:
    RecoveryScore* score_;
    std::set<int> down_;
};

}  // namespace

RecoveryScore run_recovery(const RecoveryRun& run) {
    test::WatchedProgram program({run.program, "run", "--sensor",
                                  fmt::format("sim:flat?hands={}&empty=1&seed={}&faults_every={}&fault_s={}",
                                              run.hands, run.seed, run.every_s, run.fault_s),
                                  "--pace", "live", "--display", "headless", "--events", "-"});
    RecoveryScore score;
    TouchWatch touches(score);
    auto start = Clock::now(), last = start;
    while (score.faults < run.faults) {
        touches.take(nlohmann::json::parse(program.line()));
        const auto now = Clock::now();
        const std::chrono::duration<double> gap = now - last, all = now - start;
        if (score.frames++ == 0) start = now;  // what came before is its start, not a gap
        if (score.frames > 1) score.longest_gap_s = std::max(score.longest_gap_s, gap.count());
        score.seconds = all.count();
        last = now;
        score.faults = test::faults_in(program.log());
        if (score.early_files == 0 && score.faults >= run.faults / 10) {
            score.early_mb = program.resident_mb();
            score.early_files = program.open_files();
        }
    }
    score.late_mb = program.resident_mb();
    score.late_files = program.open_files();
    score.restarts = test::restarts_in(program.log());
    score.exit_status = program.end();
    return score;
}

}  // namespace touchstone
