#pragma once

#include <memory>

#include "platform/display/display.hpp"

namespace touchstone {

/// A display without a screen: EGL surfaceless and a framebuffer object. Throws Error{unavailable} where EGL
/// or OpenGL ES 3.1 is missing.
std::unique_ptr<Display> make_headless_display(PixelSize size);

}  // namespace touchstone
