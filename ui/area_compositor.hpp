#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "platform/display/gl_framebuffer.hpp"
#include "platform/display/gl_program.hpp"
#include "ui/table_frame.hpp"

namespace touchstone {

/// What one area shows: a texture that covers the view, or null for nothing.
struct AreaLayer {
    const ShownArea* area;
    const GlTexture* layer;
};

/// Puts layers of several areas together, each within its polygon. Row 0 is the top; premultiplied alpha.
class AreaCompositor {
  public:
    AreaCompositor();

    /// Null where no area shows anything.
    const GlTexture* compose(PixelSize view, std::span<const AreaLayer> layers);

  private:
    GlProgram program_;
    std::optional<GlFramebuffer> picture_;
    GlVertexArrayHandle vertex_array_{new_gl_vertex_array()};
    GlBufferHandle buffer_{new_gl_buffer()};
    std::vector<Eigen::Vector2f> places_;
};

}  // namespace touchstone
