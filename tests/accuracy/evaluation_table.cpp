#include "tests/accuracy/evaluation_table.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <numeric>

#include "platform/system/percentile.hpp"
#include "tests/accuracy/close_pairs.hpp"
#include "tests/accuracy/touch_score.hpp"

namespace touchstone {
namespace {

std::string found_text(const Found& found) {
    if (found.contacts == 0) return "-";
    return fmt::format("{} / {} ({:.1f} %)", found.found, found.contacts, 100.0 * found.rate());
}

/// Mean and 95 % of values.
std::string spread_text(const std::vector<double>& values) {
    if (values.empty()) return "-";
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    return fmt::format("{:.1f} / {:.1f}", sum / static_cast<double>(values.size()), percentile(values, 95.0));
}

/// Shares of the contacts found that are found in their first frame or before, and at most one later.
std::string lateness_text(const std::vector<double>& late_frames) {
    if (late_frames.empty()) return "-";
    const auto percent = [&](double most) {
        const auto count = std::count_if(late_frames.begin(), late_frames.end(),
                                         [most](double late) { return late <= most; });
        return 100.0 * static_cast<double>(count) / static_cast<double>(late_frames.size());
    };
    return fmt::format("{:.0f} / {:.0f}", percent(0.0), percent(1.0));
}

std::string switches_text(const TouchScore& score) {
    if (score.drags == 0) return "-";
    return fmt::format("{:.0f} ({})", 100.0 * score.drag_id_switches / score.drags, score.drags);
}

double per_minute(int count, const TouchScore& score) { return count / std::max(1e-9, score.minutes()); }

}  // namespace

std::string contact_head() {
    return "| surface, camera m | method | contacts of 2 frames or more | all taps and contacts | spurious a "
           "minute | touch frames without a finger within 6 mm | position mm, mean / 95 % | % in the same "
           "frame "
           "/ at most one late | id switches in 100 drags (drags) | two fingers 30 to 45 mm apart |\n"
           "|---|---|---|---|---|---|---|---|---|---|\n";
}

std::string ghost_head() {
    return "| sequences | method | minutes | touches | a minute | frames with a touch, % |\n"
           "|---|---|---|---|---|---|\n";
}

std::string hover_head() {
    return "| sequences | method | hover told from touch in 95 % of frames, from mm | frames of a hovering "
           "finger "
           "| taken for a touch, % |\n|---|---|---|---|---|\n";
}

std::string contact_row(const std::string& what, const MethodSeries& method) {
    const auto& [name, series] = method;
    const TouchScore score = score_touches(series.truth(), series.log());
    const double wrong = score.false_frames / std::max(1.0, 1.0 * (score.false_frames + score.true_frames));
    return fmt::format("| {} | {} | {} | {} | {:.1f} | {:.1f} % | {} | {} | {} | {} |\n", what, name,
                       found_text(score.of_two_and_more), found_text(score.all),
                       per_minute(score.spurious_ids, score), 100.0 * wrong, spread_text(score.position_mm),
                       lateness_text(score.late_frames), switches_text(score),
                       found_text(score_close_pairs(series.truth(), series.log())));
}

std::string ghost_row(const std::string& what, const MethodSeries& method) {
    const auto& [name, series] = method;
    const TouchScore score = score_touches(series.truth(), series.log());
    const auto touched = std::count_if(series.log().begin(), series.log().end(),
                                       [](const auto& frame) { return !frame.second.empty(); });
    return fmt::format("| {} | {} | {:.2f} | {} | {:.1f} | {:.1f} |\n", what, name, score.minutes(),
                       score.spurious_ids, per_minute(score.spurious_ids, score),
                       100.0 * static_cast<double>(touched) / std::max(1, score.frames));
}

std::string hover_row(const std::string& what, const MethodSeries& method) {
    const auto& [name, series] = method;
    const HoverScore hover = score_touches(series.truth(), series.log()).hover;
    const std::string from = hover.told_from_mm ? fmt::format("{:.0f}", *hover.told_from_mm) : "never";
    return fmt::format("| {} | {} | {} | {} | {:.1f} |\n", what, name, from, hover.tips,
                       100.0 * hover.mistaken / std::max(1, hover.tips));
}

}  // namespace touchstone
