#pragma once

#include "platform/display/gl_texture.hpp"

namespace touchstone {

enum class DepthBuffer { without, with };

/// A picture to draw into: RGBA, 8 bits. Its contents are unknown until the first clear.
class GlFramebuffer {
  public:
    /// Throws Error{unavailable} when the driver cannot draw into a picture of that size. A depth buffer has
    /// 24 bits.
    explicit GlFramebuffer(PixelSize size, DepthBuffer depth = DepthBuffer::without);

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
    GlRenderbufferHandle depth_;
};

}  // namespace touchstone
