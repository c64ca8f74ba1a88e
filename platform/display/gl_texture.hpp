#pragma once

#include <cstdint>
#include <span>

#include "platform/display/gl_handle.hpp"
#include "platform/display/picture.hpp"

namespace touchstone {

enum class TexelFormat {
    rgba8,  ///< 4 bytes a pixel
    r8,     ///< 1 byte a pixel, read as red
};

/// A 2D texture with bilinear filtering, clamped at its edges.
class GlTexture {
  public:
    explicit GlTexture(PixelSize size, TexelFormat format = TexelFormat::rgba8);

    PixelSize size_px() const { return size_; }
    GLuint id() const { return handle_.id(); }
    /// Row-major texels of the whole texture; the first row lies at texture coordinate v = 0.
    void upload(std::span<const std::uint8_t> texels);
    void bind(int unit) const;

  private:
    PixelSize size_;
    TexelFormat format_;
    GlTextureHandle handle_{new_gl_texture()};
};

}  // namespace touchstone
