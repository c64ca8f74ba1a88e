#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace touchstone {

struct Curve {
    std::string name;
    bool dashed = false;                            ///< what is measured against
    std::vector<std::pair<double, double>> points;  ///< x, y; y > 0
};

struct ScalePanel {
    std::string x_axis, y_axis;
    std::vector<std::pair<double, std::string>> ticks;  ///< of x
    bool logarithmic = true;                            ///< both axes; else y from 0
    std::vector<Curve> curves;
};

/// Panels in rows of two, titles above.
struct ScaleChart {
    std::string title, note;
    std::vector<ScalePanel> panels;
};

/// What gnuplot makes the chart of.
std::string gnuplot_script(const ScaleChart& chart, const std::filesystem::path& png);

/// Writes a PNG. Throws std::runtime_error, which says what to install where gnuplot is missing.
void draw_scale_chart(const ScaleChart& chart, const std::filesystem::path& png);

}  // namespace touchstone
