#pragma once

#include <span>

#include "pipeline/interaction_pipeline.hpp"
#include "pipeline/named_areas.hpp"
#include "platform/output/touch_sink.hpp"

namespace touchstone {

/// The words of the event log: starting, scanning, live.
const char* state_word(InteractionState state);

/// What the sinks are told of one processed frame: metres become millimetres. `areas` are those that tips are
/// assigned to.
TouchReport make_report(const InteractionFrame& frame, int index, std::uint64_t time_us,
                        std::span<const NamedArea> areas = {});

}  // namespace touchstone
