#pragma once

#include "app/perception.hpp"
#include "app/presentation.hpp"
#include "app/service_watch.hpp"
#include "platform/system/termination_signals.hpp"

namespace touchstone {

/// Live pace, until one side is at its end: perception has a thread of its own and never waits for the
/// screen, and what a scene wishes is on its way before the picture is shown. Throws what perception throws.
void run_two_loops(Perception& perception, Presentation& presentation, TerminationSignals& signals,
                   ServiceWatch& watch);

}  // namespace touchstone
