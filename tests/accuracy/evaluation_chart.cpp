#include "tests/accuracy/evaluation_chart.hpp"

#include <algorithm>

#include "tests/accuracy/touch_score.hpp"

namespace touchstone {
namespace {

double spurious_a_minute(const TouchScore& score) {
    return score.spurious_ids / std::max(1e-9, score.minutes());
}

}  // namespace

BarChart evaluation_chart(const std::vector<MethodSeries>& contacts,
                          const std::vector<MethodSeries>& hovering, const std::string& measured) {
    BarPanel found{"contacts found, %", {"of two frames or more", "all, with taps of one frame"}, {}, 100.0};
    BarPanel spurious{"spurious touches a minute (log; no bar: 0)",
                      {"hands touch", "hands hover, none touches"},
                      {},
                      1.0,
                      0.1};
    BarChart chart{"Touch on simulated tables: Touchstone and published methods", measured, {}, {}};
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const auto& [method, series] = contacts[i];
        const TouchSeries& hover = hovering.at(i).series;
        const TouchScore score = score_touches(series.truth(), series.log());
        chart.groups.push_back(method);
        found.bars.push_back({100.0 * score.of_two_and_more.rate(), 100.0 * score.all.rate()});
        spurious.bars.push_back(
            {spurious_a_minute(score), spurious_a_minute(score_touches(hover.truth(), hover.log()))});
    }
    chart.panels = {found, spurious};
    return chart;
}

}  // namespace touchstone
