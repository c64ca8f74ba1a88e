#include "tests/accuracy/evaluation_table.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchstone {
namespace {

using testing::HasSubstr;

/// A minute at 30 Hz with two contacts of three frames at 10 s and 20 s.
TouchTruth minute() {
    TouchTruth truth;
    truth.tips.resize(1800);
    for (const std::size_t first : {300U, 600U})
        for (std::size_t i = first; i < first + 3; ++i) truth.tips[i] = {TrueTip{}};
    return truth;
}

MethodSeries method_of(const TouchTruth& truth, const TouchLog& log) {
    MethodSeries method{"ours", {}};
    method.series.append(truth, log);
    return method;
}

std::ptrdiff_t columns(const std::string& row) { return std::count(row.begin(), row.end(), '|'); }

TEST(EvaluationTable, ARowHasTheFiguresOfItsContacts) {
    const TouchLog log{{301, {{1, {3.0, 0.0, 0.0}}}},
                       {
                           900,
                           {{2, {0.0, 0.0, 0.0}}},
                       }};
    const std::string row = contact_row("flat 1.0", method_of(minute(), log));
    EXPECT_EQ(row,
              "| flat 1.0 | ours | 1 / 2 (50.0 %) | 1 / 2 (50.0 %) | 1.0 | 50.0 % | 3.0 / 3.0 | 0 / 100 | - "
              "| - |\n");
}

TEST(EvaluationTable, RowsFitTheirHeads) {
    const MethodSeries method = method_of(minute(), {});
    const auto head_columns = [](const std::string& head) {
        return columns(head.substr(0, head.find('\n')));
    };
    EXPECT_EQ(columns(contact_row("a", method)), head_columns(contact_head()));
    EXPECT_EQ(columns(ghost_row("a", method)), head_columns(ghost_head()));
    EXPECT_EQ(columns(hover_row("a", method)), head_columns(hover_head()));
}

TEST(EvaluationTable, GhostsAreCountedAMinute) {
    TouchTruth empty;
    empty.tips.resize(900);
    const TouchLog log{{10, {{1, {}}}}, {11, {{1, {}}}}, {500, {{2, {}}}}};
    EXPECT_EQ(ghost_row("empty", method_of(empty, log)), "| empty | ours | 0.50 | 2 | 4.0 | 0.3 |\n");
}

TEST(EvaluationTable, HoverThatIsNeverToldSaysSo) {
    TouchTruth hover;
    TouchLog log;
    for (int frame = 0; frame < 100; ++frame) {
        hover.tips.push_back({TrueTip{.hand = 0, .finger = 0, .gap_mm = 5.5, .camera_mm = {}}});
        if (frame % 2 == 0) log[frame] = {{1, {}}};
    }
    EXPECT_EQ(hover_row("low", method_of(hover, log)), "| low | ours | never | 100 | 50.0 |\n");
    EXPECT_THAT(hover_row("low", method_of(hover, {})), HasSubstr("| 5 | 100 | 0.0 |"));
}

}  // namespace
}  // namespace touchstone
