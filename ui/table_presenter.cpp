#include "ui/table_presenter.hpp"

#include "ui/canvas_renderer.hpp"
#include "ui/cross_guide.hpp"
#include "ui/finger_marks.hpp"
#include "ui/layout.hpp"
#include "ui/scene_list.hpp"
#include "ui/scenes/scan_progress.hpp"
#include "ui/status_panel.hpp"
#include "ui/surface_compositor.hpp"

namespace touchstone {

namespace {

constexpr PixelSize size_before_first_view{640, 480};
constexpr float brightness_while_waiting = 0.75f;

void draw_area(Canvas& canvas, const ViewMapping& view, const std::array<Eigen::Vector2f, 4>& area_px) {
    for (std::size_t i = 0; i < area_px.size(); ++i)
        canvas.line(view.to_display(area_px[i]), view.to_display(area_px[(i + 1) % area_px.size()]),
                    1.5f * canvas.scale(), style::white.faded(0.35f));
}

void draw_empty_view(Canvas& canvas, const DisplayRect& rect) {
    canvas.box(rect.min_px, rect.max_px, style::corner_px * canvas.scale(), style::card.faded(0.6f));
}

}  // namespace

struct TablePresenter::Parts {
    std::unique_ptr<Scene> scene;
    SurfaceCompositor compositor;
    Canvas canvas;
    CanvasRenderer canvas_renderer;
    FingerMarks fingers;
    PixelSize view_size{};
    bool scanning = false;
};

TablePresenter::TablePresenter(Display& display, const std::string& scene_name) : display_(display) {
    auto scene = make_scene(scene_name);
    parts_ = std::make_unique<Parts>();
    parts_->scene = std::move(scene);
}

TablePresenter::~TablePresenter() = default;

void TablePresenter::present(const TableFrame& frame, float dt_s) {
    clock_s_ += dt_s;
    if (frame.index != last_index_ || frame.timestamp_us != last_timestamp_us_) take_in(frame);
    last_index_ = frame.index;
    last_timestamp_us_ = frame.timestamp_us;
    parts_->scene->update(dt_s);
    draw(frame);
    display_.present();
}

SceneWish TablePresenter::wish() const { return parts_->scene->wish(); }

void TablePresenter::take_in(const TableFrame& frame) {
    Parts& p = *parts_;
    p.compositor.set_view(frame.view);
    const PixelSize view_size =
        frame.view ? PixelSize{frame.view->width_px, frame.view->height_px} : p.view_size;
    const bool scanning = frame.state == "scanning";
    const bool scan_begins = scanning && !p.scanning;
    if (view_size != p.view_size || (scan_begins && view_size.width_px > 0)) p.scene->start(view_size);
    p.view_size = view_size;
    p.scanning = scanning;
    p.scene->show(frame);
    for (const TouchEvent& event : frame.touches) {
        if (!frame.cross) p.scene->on_touch(event);
        p.fingers.on_touch(event);
    }
    p.scene->on_hovers(frame.hovers);
    p.fingers.on_hovers(frame.hovers);
    if (is_waiting_state(frame)) lift_all_fingers();
}

/// While nobody can touch, no `up` may come for a finger that was down.
void TablePresenter::lift_all_fingers() {
    for (const auto& [id, tip] : parts_->fingers.touching()) parts_->scene->on_touch({tip, TouchPhase::up});
    parts_->scene->on_hovers({});
    parts_->fingers.clear();
}

void TablePresenter::draw(const TableFrame& frame) {
    Parts& p = *parts_;
    display_.begin_frame();
    const PixelSize display = display_.size_px();
    const bool waiting = is_waiting_state(frame);
    const bool has_view = p.compositor.has_view();
    const Layout layout = make_layout(display, has_view ? p.view_size : size_before_first_view);

    glClearColor(style::backdrop.r / 255.f, style::backdrop.g / 255.f, style::backdrop.b / 255.f, 1.f);
    glClear(GL_COLOR_BUFFER_BIT);
    if (has_view)
        p.compositor.draw(layout, display, p.scene->surface_layer(), p.scene->overlay_layer(),
                          waiting ? brightness_while_waiting : 1.f);

    Canvas& canvas = p.canvas;
    canvas.begin({static_cast<float>(display.width_px), static_cast<float>(display.height_px)}, layout.scale);
    if (!has_view) draw_empty_view(canvas, layout.view.rect);
    if (frame.has_area) draw_area(canvas, layout.view, frame.area_px);
    if (waiting) {
        draw_scan_progress(canvas, layout.view.rect, frame, clock_s_);
    } else {
        p.scene->draw(canvas, layout.view);
        p.fingers.draw(canvas, layout.view);
        if (frame.cross) draw_cross_guide(canvas, layout.view, *frame.cross);
    }
    draw_status_panel(canvas, layout,
                      status_words(frame, frame.cross ? "Touch the crosses" : p.scene->invitation(),
                                   p.fingers.touching_ids()));
    p.canvas_renderer.draw(canvas);
}

}  // namespace touchstone
