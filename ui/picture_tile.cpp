#include "ui/picture_tile.hpp"

#include <cmath>

namespace touchstone {

void PictureTile::set(const Thumbnail& picture) {
    if (picture.gray.empty()) return;
    if (!texture_ || texture_->size_px() != picture.size) {
        texture_.emplace(picture.size);
        source_ = GlFramebufferHandle(new_gl_framebuffer());
        glBindFramebuffer(GL_READ_FRAMEBUFFER, source_.id());
        glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_->id(), 0);
    }
    std::vector<std::uint8_t> rgba;
    rgba.reserve(4 * picture.gray.size());
    for (const std::uint8_t gray : picture.gray) rgba.insert(rgba.end(), {gray, gray, gray, 255});
    texture_->upload(rgba);
}

void PictureTile::draw(const DisplayRect& box, PixelSize display) const {
    if (!texture_) return;
    const auto whole = [](float px) { return static_cast<GLint>(std::lround(px)); };
    const GLint bottom = display.height_px - whole(box.max_px.y()),
                top = display.height_px - whole(box.min_px.y());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, source_.id());
    // The texture's first row is its upper one; GL counts from the bottom.
    glBlitFramebuffer(0, texture_->size_px().height_px, texture_->size_px().width_px, 0,
                      whole(box.min_px.x()), bottom, whole(box.max_px.x()), top, GL_COLOR_BUFFER_BIT,
                      GL_LINEAR);
}

}  // namespace touchstone
