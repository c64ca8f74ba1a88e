#pragma once

#include <memory>
#include <string>

#include "platform/display/display.hpp"

namespace touchstone {

/// Whether read_pixels can tell what a window showed.
enum class WindowPixels { shown_only, readable };

/// A resizable window with an OpenGL ES 3.1 context, vertical sync on where the driver has it. SDL wants its
/// events taken on the thread that made the window, which is that of the display. Throws Error{unavailable}
/// where no display server can be reached.
std::unique_ptr<Display> make_sdl_display(const std::string& title, PixelSize size,
                                          WindowPixels pixels = WindowPixels::readable);

}  // namespace touchstone
