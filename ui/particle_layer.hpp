#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/particle_view.hpp"
#include "platform/display/gl_framebuffer.hpp"
#include "platform/display/gl_program.hpp"
#include "ui/instanced_quads.hpp"

namespace touchstone {

/// Spheres and their shadows as the camera sees them, hidden per pixel by the real surfaces in front of them:
/// lies over the view, hands too. Row 0 is the top; premultiplied alpha.
class ParticleLayer {
  public:
    /// For a view of that size; the layer has twice its resolution.
    explicit ParticleLayer(PixelSize view);

    /// Draws this instead of what was there. Null: nothing.
    void draw(const ParticleView* particles);
    const GlTexture& picture() const { return picture_.color(); }

  private:
    void upload_depth(const ParticleView& particles);
    void list(const ParticleView& particles);

    GlProgram program_;
    GlFramebuffer picture_;
    GlTexture real_;
    InstancedQuads quads_;
    std::vector<QuadInstance> instances_;
    std::vector<std::uint8_t> texels_;
};

}  // namespace touchstone
