#include "ui/surface_compositor.hpp"

#include "ui/shader.hpp"
#include "ui/style.hpp"

namespace touchstone {

SurfaceCompositor::SurfaceCompositor() : program_(make_program("surface")) {
    nothing_.upload(std::array<std::uint8_t, 4>{});
    program_.use();
    glUniform1i(program_.uniform("u_view"), 0);
    glUniform1i(program_.uniform("u_layer"), 1);
    glUniform1i(program_.uniform("u_overlay"), 2);
    glUniform3f(program_.uniform("u_backdrop"), style::backdrop.r / 255.f, style::backdrop.g / 255.f,
                style::backdrop.b / 255.f);
}

void SurfaceCompositor::set_view(const std::shared_ptr<const ShadedView>& view) {
    if (!view || view == shown_) return;
    const PixelSize size{view->width_px, view->height_px};
    if (!view_ || view_->size_px() != size) view_.emplace(size);
    view_->upload(view->rgba);
    shown_ = view;
}

void SurfaceCompositor::draw(const Layout& layout, PixelSize display, const GlTexture* layer,
                             const GlTexture* overlay, float brightness) {
    const DisplayRect& rect = layout.view.rect;
    const auto across = [&](float x_px) { return 2.f * x_px / static_cast<float>(display.width_px) - 1.f; };
    const auto down = [&](float y_px) { return 1.f - 2.f * y_px / static_cast<float>(display.height_px); };
    program_.use();
    glUniform4f(program_.uniform("u_rect"), across(rect.min_px.x()), down(rect.min_px.y()),
                across(rect.max_px.x()), down(rect.max_px.y()));
    glUniform2f(program_.uniform("u_half_size_px"), 0.5f * rect.size_px().x(), 0.5f * rect.size_px().y());
    glUniform1f(program_.uniform("u_corner_px"), style::corner_px * layout.scale);
    glUniform1f(program_.uniform("u_brightness"), brightness);
    view_->bind(0);
    (layer ? *layer : nothing_).bind(1);
    (overlay ? *overlay : nothing_).bind(2);
    glBindVertexArray(vertex_array_.id());
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    glBindVertexArray(0);
}

}  // namespace touchstone
