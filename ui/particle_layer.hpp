#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/particle_view.hpp"
#include "platform/display/gl_framebuffer.hpp"
#include "platform/display/gl_program.hpp"
#include "ui/instanced_quads.hpp"

namespace touchstone {

/// Spheres as the camera sees them, hidden per pixel by the real surfaces in front of them: they lie over the
/// view, hands too. Their shadows lie on the surface: a picture of their own, of half as many pixels each
/// way, for they are soft, which is made without GL: thousands of points cost a software GL more. Row 0 is
/// the top; premultiplied alpha.
class ParticleLayer {
  public:
    explicit ParticleLayer(PixelSize view);

    /// Draws this instead of what was there. Null: nothing.
    void draw(const ParticleView* particles);
    const GlTexture& picture() const { return picture_.color(); }
    const GlTexture& shadows() const { return shadows_; }

  private:
    void upload_depth(const ParticleView& particles);
    void list_spheres(const ParticleView& particles);
    void draw_shadows(const ParticleView* particles);
    void darken(const ParticleView& particles, const ParticleSphere& sphere);

    GlProgram program_;
    GlFramebuffer picture_;
    GlTexture real_, shadows_;
    InstancedQuads quads_;
    std::vector<QuadInstance> spheres_;
    std::vector<std::uint8_t> texels_, shadow_texels_;
};

}  // namespace touchstone
