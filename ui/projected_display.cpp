#include "ui/projected_display.hpp"

#include "platform/display/gl_framebuffer.hpp"
#include "ui/surface_projection.hpp"
#include "ui/view_mapping.hpp"

namespace touchstone {

namespace {

void copy(const GlFramebuffer& from, GLint to, const DisplayRect& rect) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from.id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(to));
    glBlitFramebuffer(0, 0, from.size_px().width_px, from.size_px().height_px,
                      static_cast<GLint>(rect.min_px.x()), static_cast<GLint>(rect.min_px.y()),
                      static_cast<GLint>(rect.max_px.x()), static_cast<GLint>(rect.max_px.y()),
                      GL_COLOR_BUFFER_BIT, GL_LINEAR);
}

DisplayRect all_of(PixelSize size) {
    return {{0.f, 0.f}, {static_cast<float>(size.width_px), static_cast<float>(size.height_px)}};
}

}  // namespace

struct ProjectedDisplay::Parts {
    explicit Parts(PixelSize size) : view(size), thrown(size, DepthBuffer::with) {}

    SurfaceProjection projection;
    GlFramebuffer view;    // from above
    GlFramebuffer thrown;  // the projector's picture has no depth buffer
};

ProjectedDisplay::ProjectedDisplay(Display& projector, const ProjectedDisplayConfig& config)
    : projector_(projector), config_(config), parts_(std::make_unique<Parts>(projector.size_px())) {}

ProjectedDisplay::~ProjectedDisplay() = default;

void ProjectedDisplay::set_mapping(const ProjectorModel& model, const ViewFromAbove& view,
                                   const SurfaceGrid* surface) {
    parts_->projection.set_mapping(model, view, surface);
    if (parts_->view.size_px() != view.size_px()) parts_->view = GlFramebuffer(view.size_px());
}

void ProjectedDisplay::see_hands(const TableFrame& told) {
    if (config_.spare_hands && told.view && told.intrinsics.fx_px > 0.f)
        parts_->projection.set_hands(*told.view, told.intrinsics, told.T_g_c);
    else
        parts_->projection.forget_hands();
}

PixelSize ProjectedDisplay::size_px() const { return parts_->view.size_px(); }

void ProjectedDisplay::begin_frame() { parts_->view.bind(); }

void ProjectedDisplay::present() {
    Parts& p = *parts_;
    projector_.begin_frame();
    GLint screen = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &screen);
    const PixelSize size = projector_.size_px();
    if (p.projection.has_mapping()) {
        if (p.thrown.size_px() != size) p.thrown = GlFramebuffer(size, DepthBuffer::with);
        p.thrown.bind();
        p.projection.draw(p.view.color());
        copy(p.thrown, screen, all_of(size));
    } else {
        glClearColor(0.f, 0.f, 0.f, 1.f);
        glClear(GL_COLOR_BUFFER_BIT);
        copy(p.view, screen, fit_view(p.view.size_px(), all_of(size)).rect);
    }
    projector_.present();
}

Picture ProjectedDisplay::read_pixels() { return projector_.read_pixels(); }

bool ProjectedDisplay::should_close() { return projector_.should_close(); }

}  // namespace touchstone
