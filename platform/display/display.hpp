#pragma once

#include <optional>

#include "platform/display/picture.hpp"

namespace touchstone {

/// A place to draw with OpenGL ES 3.1: off screen, a window or all of a projector. The context of a display
/// is current on the thread that made the display, and only there: make, use and destroy a display, and
/// everything of GL, on one thread. That need not be the main thread. One display a thread.
class Display {
  public:
    virtual ~Display() = default;
    /// Of the frame being drawn; a window's changes only in begin_frame.
    virtual PixelSize size_px() const = 0;
    /// Binds the picture to draw into and sets the viewport to all of it. Nothing is cleared.
    virtual void begin_frame() = 0;
    /// Shows the picture. It stays readable until the next begin_frame.
    virtual void present() = 0;
    /// What was drawn last; waits for the drawing to end. Of a window only where that was asked for.
    virtual Picture read_pixels() = 0;
    /// Takes the waiting window events: true once the user has asked to quit (window closed, Escape).
    virtual bool should_close() = 0;
    /// The next key pressed among the events taken, as the sign it writes, in the order in which they came.
    virtual std::optional<char> take_key() { return std::nullopt; }
    /// The driver has given the context up, or the picture can no longer be shown: only a new display helps.
    virtual bool is_lost() const { return false; }
};

}  // namespace touchstone
