#include "ui/projected_display.hpp"

#include "platform/display/gl_framebuffer.hpp"
#include "ui/surface_projection.hpp"
#include "ui/view_mapping.hpp"

namespace touchstone {

namespace {

/// As large as fits into the picture that is bound, of that size.
void show_as_it_is(const GlFramebuffer& view, PixelSize size) {
    GLint screen = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &screen);
    const DisplayRect rect =
        fit_view(view.size_px(),
                 {{0.f, 0.f}, {static_cast<float>(size.width_px), static_cast<float>(size.height_px)}})
            .rect;
    glClearColor(0.f, 0.f, 0.f, 1.f);
    glClear(GL_COLOR_BUFFER_BIT);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, view.id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(screen));
    glBlitFramebuffer(0, 0, view.size_px().width_px, view.size_px().height_px,
                      static_cast<GLint>(rect.min_px.x()), static_cast<GLint>(rect.min_px.y()),
                      static_cast<GLint>(rect.max_px.x()), static_cast<GLint>(rect.max_px.y()),
                      GL_COLOR_BUFFER_BIT, GL_LINEAR);
}

}  // namespace

struct ProjectedDisplay::Parts {
    explicit Parts(PixelSize size) : view(size) {}

    SurfaceProjection projection;
    GlFramebuffer view;  // from above
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
    projector_.begin_frame();  // a window has its new size from here on
    if (!p.projection.has_mapping()) {
        show_as_it_is(p.view, projector_.size_px());
    } else {
        if (p.projection.prepare(projector_.size_px())) projector_.begin_frame();
        p.projection.draw(p.view.color());
    }
    projector_.present();
}

Picture ProjectedDisplay::read_pixels() { return projector_.read_pixels(); }

bool ProjectedDisplay::should_close() { return projector_.should_close(); }

}  // namespace touchstone
