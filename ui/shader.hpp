#pragma once

#include <string_view>

#include "platform/display/gl_program.hpp"

namespace touchstone {

/// The program of ui/shaders/NAME.vert and NAME.frag.
GlProgram make_program(std::string_view name);

}  // namespace touchstone
