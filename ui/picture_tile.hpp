#pragma once

#include <optional>

#include "platform/display/gl_handle.hpp"
#include "platform/display/gl_texture.hpp"
#include "ui/operator_view.hpp"
#include "ui/view_mapping.hpp"

namespace touchstone {

/// A gray picture on the display. Lives while its context is current.
class PictureTile {
  public:
    void set(const Thumbnail& picture);
    /// Fills the box of the picture that is being drawn, `display` pixels large, over what is there.
    void draw(const DisplayRect& box, PixelSize display) const;

  private:
    std::optional<GlTexture> texture_;
    GlFramebufferHandle source_;
};

}  // namespace touchstone
