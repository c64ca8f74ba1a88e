#pragma once

#include <cstdint>
#include <vector>

#include "platform/output/osc_bundle.hpp"

namespace touchstone {

/// One cursor: place in 0..1 of the area, velocity in widths (heights) a second, acceleration of the speed in
/// the same a second squared. z is the height over the surface as a share of the one that is 1.
struct TuioCursor {
    std::int32_t session = 0;
    float x = 0.f, y = 0.f, z = 0.f;
    float velocity_x = 0.f, velocity_y = 0.f, velocity_z = 0.f;
    float acceleration = 0.f;
};

/// One state of the table as a client takes it. fseq -1 marks a repetition of what was said before.
struct TuioBundle {
    std::vector<std::int32_t> alive;
    std::vector<TuioCursor> cursors;
    std::int32_t fseq = -1;
};

/// Touches on the surface (/tuio/2Dcur), or fingers over it as well, with their height (/tuio/25Dcur).
enum class TuioProfile { cursors_2d, cursors_25d };

/// The state as OSC, in as many bundles as it takes for each to be at most `largest` bytes. Source, alive
/// list and fseq are in all of them.
std::vector<OscBundle> osc_bundles(const TuioBundle& state, TuioProfile profile, const std::string& source,
                                   std::size_t largest);

}  // namespace touchstone
