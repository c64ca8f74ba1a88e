#include "tests/benchmarks/scale_chart.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;

ScaleChart one_panel() {
    return {"title",
            "note",
            {{"voxels",
              "ms",
              {{256.0, "256^3"}, {512.0, "512^3"}},
              true,
              {{"ours", false, {{256.0, 1.5}, {512.0, 2.0}}}, {"dense", true, {{256.0, 9.0}}}}}}};
}

TEST(ScaleChart, EveryCurveHasItsPointsAndItsDash) {
    const std::string script = gnuplot_script(one_panel(), "a.png");
    EXPECT_THAT(script, HasSubstr("$panel0curve0 << END\n256 1.5000\n512 2.0000\nEND\n"));
    EXPECT_THAT(script, HasSubstr("dashtype 1 title \"ours\""));
    EXPECT_THAT(script, HasSubstr("dashtype 2 title \"dense\""));
    EXPECT_THAT(script, HasSubstr("set xtics (\"256^3\" 256, \"512^3\" 512)"));
}

TEST(ScaleChart, WhatWasNotMeasuredIsNotDrawn) {
    ScaleChart chart = one_panel();
    chart.panels[0].curves[1].points.clear();
    EXPECT_THAT(gnuplot_script(chart, "a.png"), testing::Not(HasSubstr("title \"dense\"")));
}

TEST(ScaleChart, GnuplotUnderstandsIt) {
    if (std::system("command -v gnuplot >/dev/null") != 0) GTEST_SKIP() << "gnuplot is not installed";
    const TemporaryFolder folder;
    const auto png = folder / "chart.png";
    draw_scale_chart(one_panel(), png);
    EXPECT_GT(std::filesystem::file_size(png), 1000U);
}

}  // namespace
}  // namespace touchstone
