#include "tests/accuracy/bar_chart.hpp"

#include <algorithm>
#include <fmt/core.h>

#include "tests/support/gnuplot.hpp"

namespace touchstone {
namespace {

constexpr int wide_px = 1500, panel_px = 460, title_px = 90;

/// In double quotes, for gnuplot.
std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        result += c == '\n' ? std::string("\\n") : std::string(1, c);
    }
    return result + '"';
}

/// A line for each group: its name, then its values.
std::string data_block(const BarChart& chart, std::size_t panel) {
    std::string text = fmt::format("$panel{} << END\n", panel);
    for (std::size_t group = 0; group < chart.groups.size(); ++group) {
        text += quoted(chart.groups[group]);
        for (const double value : chart.panels[panel].bars[group]) text += fmt::format(" {:.4f}", value);
        text += '\n';
    }
    return text + "END\n";
}

double highest(const BarPanel& panel) {
    double most = panel.at_least;
    for (const auto& group : panel.bars)
        for (const double value : group) most = std::max(most, value);
    return most;
}

/// The value of a column, at least where the axis begins: a logarithmic one has no place for 0.
std::string height_of(const BarPanel& panel, std::size_t column) {
    return panel.log_from > 0.0 ? fmt::format("(${0}>{1}?${0}:{1})", column, panel.log_from)
                                : fmt::format("(${})", column);
}

std::string plot_command(const BarPanel& panel, std::size_t number) {
    std::string command = "plot ";
    const double count = static_cast<double>(panel.series.size()), step = 1.0 / (count + 1.0);
    for (std::size_t i = 0; i < panel.series.size(); ++i) {
        const std::size_t column = i + 2;
        const std::string height = height_of(panel, column);
        const double aside = (static_cast<double>(i) - 0.5 * (count - 1.0)) * step;
        command += fmt::format("{}$panel{} using {}{} title {} linecolor {}", i > 0 ? ", " : "", number,
                               height, i == 0 ? ":xtic(1)" : "", quoted(panel.series[i]), i + 1);
        command += fmt::format(
            ", $panel{} using ($0{:+.3f}):{}:(sprintf(\"%.4g\", ${})) with labels offset 0,0.6 font \",9\" "
            "notitle",
            number, aside, height, column);
    }
    return command + '\n';
}

std::string axis_command(const BarPanel& panel) {
    const bool logarithmic = panel.log_from > 0.0;
    return fmt::format("set ylabel {}\n{}\nset yrange [{}:{:.3f}]\n", quoted(panel.axis),
                       logarithmic ? "set logscale y" : "unset logscale y", panel.log_from,
                       (logarithmic ? 3.0 : 1.12) * highest(panel));
}

}  // namespace

std::string gnuplot_script(const BarChart& chart, const std::filesystem::path& png) {
    std::string script;
    for (std::size_t panel = 0; panel < chart.panels.size(); ++panel) script += data_block(chart, panel);
    const int high_px = title_px + panel_px * static_cast<int>(chart.panels.size());
    script += fmt::format(
        "set terminal pngcairo noenhanced size {},{} font \"DejaVu Sans,12\"\nset output {}\n"
        "set style data histogram\nset style histogram clustered gap 1\n"
        "set style fill solid 0.9 border -1\nset grid ytics\nset xtics rotate by -18 nomirror\n"
        "set linetype 1 linecolor rgb \"#2a6fbb\"\nset linetype 2 linecolor rgb \"#e08a2e\"\n"
        "set tmargin 3\nset key outside top right horizontal\nset multiplot layout {},1 title {}\n",
        wide_px, high_px, quoted(png.string()), chart.panels.size(), quoted(chart.title + "\n" + chart.note));
    for (std::size_t panel = 0; panel < chart.panels.size(); ++panel)
        script += axis_command(chart.panels[panel]) + plot_command(chart.panels[panel], panel);
    return script + "unset multiplot\n";
}

void draw_bar_chart(const BarChart& chart, const std::filesystem::path& png) {
    test::run_gnuplot(gnuplot_script(chart, png));
}

}  // namespace touchstone
