#include "platform/display/gl_framebuffer.hpp"

#include <algorithm>
#include <string>

#include "platform/system/error.hpp"

namespace touchstone {

GlFramebuffer::GlFramebuffer(PixelSize size) : color_(size) {
    glBindFramebuffer(GL_FRAMEBUFFER, handle_.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_.id(), 0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw Error(ExitStatus::unavailable,
                    "The graphics driver cannot draw into a picture of " + std::to_string(size.width_px) +
                        "x" + std::to_string(size.height_px) + " pixels; choose a smaller display size");
}

void GlFramebuffer::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, handle_.id());
    glViewport(0, 0, size_px().width_px, size_px().height_px);
}

Picture GlFramebuffer::read() const {
    Picture picture{size_px().width_px, size_px().height_px, {}};
    const auto row_bytes = static_cast<std::ptrdiff_t>(picture.width_px) * 4;
    picture.rgba.resize(static_cast<std::size_t>(row_bytes) * static_cast<std::size_t>(picture.height_px));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, handle_.id());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, picture.width_px, picture.height_px, GL_RGBA, GL_UNSIGNED_BYTE, picture.rgba.data());
    const auto first = picture.rgba.begin();
    for (int top = 0, bottom = picture.height_px - 1; top < bottom; ++top, --bottom)
        std::swap_ranges(first + top * row_bytes, first + (top + 1) * row_bytes, first + bottom * row_bytes);
    return picture;
}

}  // namespace touchstone
