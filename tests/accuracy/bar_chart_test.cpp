#include "tests/accuracy/bar_chart.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;

BarChart two_groups() {
    return {"a \"title\"",
            "a note",
            {"one", "two"},
            {{"found, %", {"a", "b"}, {{50.0, 60.0}, {99.5, 100.0}}, 100.0},
             {"a minute", {"c"}, {{0.0}, {250.0}}, 1.0}}};
}

TEST(BarChart, EveryGroupHasALineOfItsValuesInEveryPanel) {
    const std::string script = gnuplot_script(two_groups(), "/tmp/a.png");
    EXPECT_THAT(script, HasSubstr("$panel0 << END\n\"one\" 50.0000 60.0000\n\"two\" 99.5000 100.0000\nEND"));
    EXPECT_THAT(script, HasSubstr("$panel1 << END\n\"one\" 0.0000\n\"two\" 250.0000\nEND"));
}

TEST(BarChart, TextIsQuotedForGnuplot) {
    const std::string script = gnuplot_script(two_groups(), "/tmp/a.png");
    EXPECT_THAT(script, HasSubstr(R"(title "a \"title\"\na note")"));
}

TEST(BarChart, TheAxisStartsAtZeroAndHasRoomForTheHighestValue) {
    const std::string script = gnuplot_script(two_groups(), "/tmp/a.png");
    EXPECT_THAT(script, HasSubstr("set ylabel \"found, %\"\nunset logscale y\nset yrange [0:112.000]"));
    EXPECT_THAT(script, HasSubstr("set ylabel \"a minute\"\nunset logscale y\nset yrange [0:280.000]"));
}

TEST(BarChart, ALogarithmicAxisShowsZeroAsABarOfNoHeight) {
    BarChart chart = two_groups();
    chart.panels[1].log_from = 0.1;
    const std::string script = gnuplot_script(chart, "/tmp/a.png");
    EXPECT_THAT(script, HasSubstr("set logscale y\nset yrange [0.1:750.000]"));
    EXPECT_THAT(script, HasSubstr("($2>0.1?$2:0.1):xtic(1)"));
    EXPECT_THAT(script, HasSubstr("sprintf(\"%.4g\", $2)")) << "the label is the value itself";
}

TEST(BarChart, WritesAPngOrSaysWhatIsMissing) {
    const TemporaryFolder folder;
    const auto png = folder / "chart.png";
    if (std::system("command -v gnuplot >/dev/null") == 0) {
        draw_bar_chart(two_groups(), png);
        EXPECT_GT(std::filesystem::file_size(png), 1000U);
        return;
    }
    try {
        draw_bar_chart(two_groups(), png);
        FAIL() << "without gnuplot there is no chart";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("gnuplot-nox"));
    }
}

}  // namespace
}  // namespace touchstone
