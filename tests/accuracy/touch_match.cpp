#include "tests/accuracy/touch_match.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tests/accuracy/assignment.hpp"

namespace touchstone {
namespace {

constexpr double reach_mm = 25.0;
constexpr double unreachable = 1e6;

}  // namespace

std::vector<TouchMatch> match_touches(const std::vector<TrueTip>& tips,
                                      const std::vector<LoggedTouch>& touches) {
    CostMatrix distance_mm(tips.size(), std::vector<double>(touches.size()));
    for (std::size_t i = 0; i < tips.size(); ++i) {
        for (std::size_t j = 0; j < touches.size(); ++j) {
            const auto &a = tips[i].camera_mm, &b = touches[j].camera_mm;
            const double mm = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
            distance_mm[i][j] = mm > reach_mm ? unreachable : mm;
        }
    }
    std::vector<TouchMatch> found;
    for (const auto& [i, j] : least_cost_assignment(distance_mm)) {
        if (distance_mm[i][j] <= reach_mm) found.push_back({i, j, distance_mm[i][j]});
    }
    return found;
}

std::vector<TrueTip> tips_within(const std::vector<TrueTip>& tips, double gap_mm) {
    std::vector<TrueTip> near;
    std::copy_if(tips.begin(), tips.end(), std::back_inserter(near),
                 [&](const TrueTip& t) { return t.gap_mm <= gap_mm; });
    return near;
}

}  // namespace touchstone
