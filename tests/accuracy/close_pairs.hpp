#pragma once

#include "tests/accuracy/touch_score.hpp"

namespace touchstone {

/// Times in which both fingers of a hand are down, 30 to 45 mm apart: found where in one of their frames, or
/// the three after, each has a touch of its own.
Found score_close_pairs(const TouchTruth& truth, const TouchLog& log);

}  // namespace touchstone
