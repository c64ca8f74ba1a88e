#pragma once

#include <array>
#include <memory>
#include <optional>

#include "pipeline/types.hpp"
#include "platform/display/gl_program.hpp"
#include "platform/display/gl_texture.hpp"
#include "ui/layout.hpp"

namespace touchstone {

/// Fig 14f: draws the shaded view with a scene's layer on its background and under its moving foreground, and
/// one over both.
class SurfaceCompositor {
  public:
    /// `darkest_paint`: how bright paint is on a black surface; 1 where a real surface shades it.
    explicit SurfaceCompositor(float darkest_paint = 0.48f);

    /// Uploads the view unless it is the one of the last call. Null keeps the last one.
    void set_view(const std::shared_ptr<const ShadedView>& view);
    bool has_view() const { return view_.has_value(); }

    /// Draws into the bound picture of that size. `layer` and `overlay`, which lies over the foreground, too,
    /// may be null; `brightness` 1 shows the view as it is.
    void draw(const Layout& layout, PixelSize display, const GlTexture* layer, const GlTexture* overlay,
              float brightness);

  private:
    std::array<GlProgram, 4> programs_;  // bare, with a layer, with an overlay, with both
    GlVertexArrayHandle vertex_array_{new_gl_vertex_array()};
    std::optional<GlTexture> view_;
    std::shared_ptr<const ShadedView> shown_;  // held, so that a new view cannot have the address of this one
};

}  // namespace touchstone
