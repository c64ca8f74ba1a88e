#pragma once

#include <cstddef>
#include <optional>

#include "platform/display/gl_program.hpp"
#include "platform/display/gl_texture.hpp"
#include "ui/canvas.hpp"

namespace touchstone {

/// Draws a canvas over what the bound picture shows.
class CanvasRenderer {
  public:
    CanvasRenderer();
    void draw(Canvas& canvas);

  private:
    void upload_letters(Canvas& canvas);

    GlProgram program_;
    GLint size_px_uniform_;
    GlVertexArrayHandle vertex_array_{new_gl_vertex_array()};
    GlBufferHandle vertices_{new_gl_buffer()};
    GlBufferHandle indices_{new_gl_buffer()};
    std::optional<GlTexture> letters_;
    int letters_version_ = 0;
};

}  // namespace touchstone
