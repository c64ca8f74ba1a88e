#include "platform/display/gl_texture.hpp"

#include <cassert>

namespace touchstone {

GlTexture::GlTexture(PixelSize size, TexelFormat format) : size_(size), format_(format) {
    bind(0);
    glTexStorage2D(GL_TEXTURE_2D, 1, format == TexelFormat::rgba8 ? GL_RGBA8 : GL_R8, size.width_px,
                   size.height_px);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void GlTexture::upload(std::span<const std::uint8_t> texels) {
    const bool rgba = format_ == TexelFormat::rgba8;
    assert(texels.size() == static_cast<std::size_t>(size_.width_px) *
                                static_cast<std::size_t>(size_.height_px) * (rgba ? 4U : 1U));
    bind(0);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size_.width_px, size_.height_px, rgba ? GL_RGBA : GL_RED,
                    GL_UNSIGNED_BYTE, texels.data());
}

void GlTexture::bind(int unit) const {
    glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
    glBindTexture(GL_TEXTURE_2D, handle_.id());
}

}  // namespace touchstone
