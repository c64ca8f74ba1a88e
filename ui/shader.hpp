#pragma once

#include <span>
#include <string_view>

#include "platform/display/gl_program.hpp"

namespace touchstone {

/// The program of ui/shaders/NAME.vert and NAME.frag.
GlProgram make_program(std::string_view name);
/// Of ui/shaders/VERTEX.vert and FRAGMENT.frag, the latter with these macros defined: what a picture does not
/// need then costs nothing.
GlProgram make_program(std::string_view vertex, std::string_view fragment,
                       std::span<const std::string_view> macros);

}  // namespace touchstone
