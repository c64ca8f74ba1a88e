#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace touchstone {

struct BarPanel {
    std::string axis;                       ///< what is drawn, with its unit
    std::vector<std::string> series;        ///< names of the bars of a group
    std::vector<std::vector<double>> bars;  ///< for each group, one value for each series
    double at_least = 1.0;                  ///< the axis reaches this high, whatever the values
    double log_from = 0.0;                  ///< where a logarithmic axis begins; 0 = linear, from 0
};

/// Panels one above the other, with the same groups.
struct BarChart {
    std::string title;
    std::string note;  ///< below the title: what was measured
    std::vector<std::string> groups;
    std::vector<BarPanel> panels;
};

/// What gnuplot makes the chart of.
std::string gnuplot_script(const BarChart& chart, const std::filesystem::path& png);

/// Writes a PNG. Throws std::runtime_error, which says what to install where gnuplot is missing.
void draw_bar_chart(const BarChart& chart, const std::filesystem::path& png);

}  // namespace touchstone
