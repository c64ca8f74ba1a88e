#pragma once

#include "platform/display/gl_texture.hpp"

namespace touchstone {

/// A picture to draw into: RGBA, 8 bits, no depth buffer. Its contents are unknown until the first clear.
class GlFramebuffer {
  public:
    /// Throws Error{unavailable} when the driver cannot draw into a picture of that size.
    explicit GlFramebuffer(PixelSize size);

    PixelSize size_px() const { return color_.size_px(); }
    const GlTexture& color() const { return color_; }
    GLuint id() const { return handle_.id(); }
    /// Drawing goes here, the viewport is all of it.
    void bind() const;
    /// Waits for the drawing; the row that GL calls the topmost comes first.
    Picture read() const;

  private:
    GlTexture color_;
    GlFramebufferHandle handle_{new_gl_framebuffer()};
};

}  // namespace touchstone
