#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/particle_view.hpp"
#include "platform/display/gl_framebuffer.hpp"
#include "platform/display/gl_program.hpp"
#include "ui/instanced_quads.hpp"

namespace touchstone {

/// Spheres as the camera sees them, hidden per pixel by the real surfaces in front of them: they lie over the
/// view, hands too. Their shadows lie on the surface: a picture of their own, coarser, for they are soft. Row
/// 0 is the top; premultiplied alpha.
class ParticleLayer {
  public:
    /// For a view of that size; the spheres have twice its resolution.
    explicit ParticleLayer(PixelSize view);

    /// Draws this instead of what was there. Null: nothing.
    void draw(const ParticleView* particles);
    const GlTexture& picture() const { return picture_.color(); }
    const GlTexture& shadows() const { return shadow_picture_.color(); }

  private:
    void upload_depth(const ParticleView& particles);
    void list(const ParticleView& particles);

    GlProgram spheres_program_, shadows_program_;
    GlFramebuffer picture_, shadow_picture_;
    GlTexture real_;
    InstancedQuads quads_;
    std::vector<QuadInstance> spheres_, shadows_;
    std::vector<std::uint8_t> texels_;
};

}  // namespace touchstone
