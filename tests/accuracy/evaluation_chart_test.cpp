#include "tests/accuracy/evaluation_chart.hpp"

#include <gtest/gtest.h>

namespace touchstone {
namespace {

TEST(EvaluationChart, ShowsWhatEachMethodFindsAndMakesUp) {
    TouchTruth contacts;
    contacts.tips.resize(900);
    for (const std::size_t frame : {100U, 101U, 500U}) contacts.tips[frame] = {TrueTip{}};
    TouchTruth hovering;
    hovering.tips.resize(1800);
    std::vector<MethodSeries> touching{{"ours", {}}}, above{{"ours", {}}};
    touching[0].series.append(contacts, {{100, {{1, {}}}}, {300, {{2, {}}}}});
    above[0].series.append(hovering, {{7, {{1, {}}}}});
    const BarChart chart = evaluation_chart(touching, above, "seeds 1 to 1");
    EXPECT_EQ(chart.groups, std::vector<std::string>{"ours"});
    EXPECT_EQ(chart.note, "seeds 1 to 1");
    ASSERT_EQ(chart.panels.size(), 2U);
    EXPECT_EQ(chart.panels[0].bars, (std::vector<std::vector<double>>{{100.0, 50.0}}));
    EXPECT_EQ(chart.panels[1].bars, (std::vector<std::vector<double>>{{2.0, 1.0}}));
}

}  // namespace
}  // namespace touchstone
