#pragma once

#include <vector>

#include "platform/display/output_choice.hpp"

namespace touchstone {

/// The outputs as SDL counts them, while its video runs: the primary one first where there is such.
std::vector<Output> sdl_outputs();

/// All outputs: of the display server that can be reached, else of the bare console, else what the kernel
/// knows of them. Starts and ends SDL's video.
std::vector<Output> list_outputs();

}  // namespace touchstone
