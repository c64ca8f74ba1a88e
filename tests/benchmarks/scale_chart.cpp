#include "tests/benchmarks/scale_chart.hpp"

#include <algorithm>
#include <fmt/core.h>

#include "tests/support/gnuplot.hpp"

namespace touchstone {

namespace {

constexpr int wide_px = 1400, row_px = 420, title_px = 90;

std::string data_blocks(const ScalePanel& panel, std::size_t number) {
    std::string text;
    for (std::size_t i = 0; i < panel.curves.size(); ++i) {
        text += fmt::format("$panel{}curve{} << END\n", number, i);
        for (const auto& [x, y] : panel.curves[i].points) text += fmt::format("{} {:.4f}\n", x, y);
        text += "END\n";
    }
    return text;
}

std::string ranges(const ScalePanel& panel) {
    const double first = panel.ticks.front().first, last = panel.ticks.back().first;
    double least = 1e30, most = 0.0;
    for (const Curve& curve : panel.curves) {
        for (const auto& [x, y] : curve.points) {
            least = std::min(least, y);
            most = std::max(most, y);
        }
    }
    if (!panel.logarithmic)
        return fmt::format("unset logscale\nset xrange [{}:{}]\nset yrange [0:{}]", first - 0.2, last + 0.2,
                           1.25 * most);
    return fmt::format("set logscale xy\nset xrange [{}:{}]\nset yrange [{}:{}]", 0.85 * first, 1.2 * last,
                       0.5 * least, 2.5 * most);
}

std::string axes(const ScalePanel& panel) {
    std::string ticks;
    for (const auto& [x, label] : panel.ticks)
        ticks += fmt::format("{}\"{}\" {}", ticks.empty() ? "" : ", ", label, x);
    return fmt::format("set xlabel \"{}\"\nset ylabel \"{}\"\nset xtics ({})\n{}\n", panel.x_axis,
                       panel.y_axis, ticks, ranges(panel));
}

/// Values stand above or below their points, to the left or to the right, by curve.
std::string plot_command(const ScalePanel& panel, std::size_t number) {
    std::string command;
    for (std::size_t i = 0; i < panel.curves.size(); ++i) {
        const Curve& curve = panel.curves[i];
        if (curve.points.empty()) continue;
        const std::string block = fmt::format("$panel{}curve{}", number, i);
        command += fmt::format(
            "{0}{1} using 1:2 with linespoints pointtype 7 linewidth 2 linecolor {2} dashtype {3} title "
            "\"{4}\", "
            "{1} using 1:2:(sprintf($2 < 100 ? \"%.3g\" : \"%.0f\", $2)) with labels textcolor linetype {2} "
            "offset {5},{6} font \",9\" notitle",
            command.empty() ? "plot " : ", ", block, i + 1, curve.dashed ? 2 : 1, curve.name,
            i < 2 ? -2.2 : 2.2, i % 2 == 0 ? 0.8 : -0.8);
    }
    return command + '\n';
}

}  // namespace

std::string gnuplot_script(const ScaleChart& chart, const std::filesystem::path& png) {
    std::string script;
    for (std::size_t i = 0; i < chart.panels.size(); ++i) script += data_blocks(chart.panels[i], i);
    const std::size_t rows = (chart.panels.size() + 1) / 2;
    script += fmt::format(
        "set terminal pngcairo noenhanced size {},{} font \"DejaVu Sans,11\"\nset output \"{}\"\nset grid\n"
        "set linetype 1 linecolor rgb \"#2a6fbb\"\nset linetype 2 linecolor rgb \"#3a9d5d\"\n"
        "set linetype 3 linecolor rgb \"#8a5fbf\"\nset linetype 4 linecolor rgb \"#e08a2e\"\n"
        "set linetype 5 linecolor rgb \"#c0392b\"\nset key above maxrows 1 font \",9\"\n"
        "set multiplot layout {},2 title \"{}\\n{}\\n\"\n",
        wide_px, title_px + row_px * static_cast<int>(rows), png.string(), rows, chart.title, chart.note);
    for (std::size_t i = 0; i < chart.panels.size(); ++i)
        script += axes(chart.panels[i]) + plot_command(chart.panels[i], i);
    return script + "unset multiplot\n";
}

void draw_scale_chart(const ScaleChart& chart, const std::filesystem::path& png) {
    test::run_gnuplot(gnuplot_script(chart, png));
}

}  // namespace touchstone
