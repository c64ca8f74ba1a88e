#include "ui/surface_compositor.hpp"

#include "ui/shader.hpp"
#include "ui/style.hpp"

namespace touchstone {

namespace {

constexpr std::array<std::string_view, 2> macros{"HAS_LAYER", "HAS_OVERLAY"};

}  // namespace

SurfaceCompositor::SurfaceCompositor(float darkest_paint)
    : programs_{make_program("surface"), make_program("surface", "surface", std::span(macros).first(1)),
                make_program("surface", "surface", std::span(macros).last(1)),
                make_program("surface", "surface", macros)} {
    for (const GlProgram& program : programs_) {
        program.use();
        glUniform1i(program.uniform("u_view"), 0);
        glUniform1i(program.uniform("u_layer"), 1);
        glUniform1i(program.uniform("u_overlay"), 2);
        glUniform3f(program.uniform("u_backdrop"), style::backdrop.r / 255.f, style::backdrop.g / 255.f,
                    style::backdrop.b / 255.f);
        glUniform1f(program.uniform("u_darkest_paint"), darkest_paint);
    }
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
    const GlProgram& program = programs_[(layer ? 1U : 0U) + (overlay ? 2U : 0U)];
    program.use();
    glUniform4f(program.uniform("u_rect"), across(rect.min_px.x()), down(rect.min_px.y()),
                across(rect.max_px.x()), down(rect.max_px.y()));
    glUniform2f(program.uniform("u_half_size_px"), 0.5f * rect.size_px().x(), 0.5f * rect.size_px().y());
    glUniform1f(program.uniform("u_corner_px"), layout.corner_px);
    glUniform1f(program.uniform("u_brightness"), brightness);
    view_->bind(0);
    if (layer) layer->bind(1);
    if (overlay) overlay->bind(2);
    glBindVertexArray(vertex_array_.id());
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    glBindVertexArray(0);
}

}  // namespace touchstone
