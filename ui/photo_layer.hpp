#pragma once

#include <map>
#include <optional>

#include "platform/display/gl_framebuffer.hpp"
#include "platform/display/gl_program.hpp"
#include "ui/photo_table.hpp"

namespace touchstone {

/// Photos with a white border and a soft shadow, as they lie on the surface. Row 0 is the top; premultiplied
/// alpha.
class PhotoLayer {
  public:
    PhotoLayer();
    /// For a view of that size from now on; the layer has twice its resolution. The pictures stay.
    void set_view(PixelSize view);

    void set_picture(int card_id, const Picture& picture);
    /// Draws these instead of what was there, in their order. `mm_per_px` is of the depth picture.
    void draw(const std::vector<PhotoCard>& cards, float mm_per_px);
    /// Null before set_view.
    const GlTexture* picture() const { return picture_ ? &picture_->color() : nullptr; }

  private:
    void draw_card(const PhotoCard& card, float layer_px_per_mm);

    GlProgram program_;
    std::optional<GlFramebuffer> picture_;
    GlVertexArrayHandle vertex_array_{new_gl_vertex_array()};
    std::map<int, GlTextureHandle> pictures_;  // by card
};

}  // namespace touchstone
