#pragma once

#include <vector>

#include "tests/accuracy/touch_record.hpp"

namespace touchstone {

/// A fingertip and a touch that belong together, by their places in their lists.
struct TouchMatch {
    std::size_t tip = 0;
    std::size_t touch = 0;
    double distance_mm = 0.0;
};

/// One to one, with the least sum of distances; none is farther than 25 mm.
std::vector<TouchMatch> match_touches(const std::vector<TrueTip>& tips,
                                      const std::vector<LoggedTouch>& touches);

/// The tips with a gap of at most so much.
std::vector<TrueTip> tips_within(const std::vector<TrueTip>& tips, double gap_mm);

}  // namespace touchstone
