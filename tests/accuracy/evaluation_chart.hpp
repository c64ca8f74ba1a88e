#pragma once

#include "tests/accuracy/bar_chart.hpp"
#include "tests/accuracy/evaluation.hpp"

namespace touchstone {

/// Contacts found, and touches where there were none, of each method.
BarChart evaluation_chart(const std::vector<MethodSeries>& contacts,
                          const std::vector<MethodSeries>& hovering, const std::string& measured);

}  // namespace touchstone
