#include "ui/table_presenter.hpp"

#include <algorithm>
#include <set>

#include "ui/canvas_fade.hpp"
#include "ui/canvas_renderer.hpp"
#include "ui/cross_guide.hpp"
#include "ui/finger_marks.hpp"
#include "ui/idle_watch.hpp"
#include "ui/layout.hpp"
#include "ui/operator_panel.hpp"
#include "ui/scenes/attract.hpp"
#include "ui/scenes/scan_progress.hpp"
#include "ui/scenes/split.hpp"
#include "ui/status_panel.hpp"
#include "ui/surface_compositor.hpp"
#include "ui/touch_menu.hpp"

namespace touchstone {

namespace {

constexpr PixelSize size_before_first_view{640, 480};
constexpr float brightness_while_waiting = 0.75f, brightness_while_idle = 0.5f;
constexpr float fall_idle_s = 2.f, wake_s = 0.3f;

void draw_area(Canvas& canvas, const ViewMapping& view, const std::array<Eigen::Vector2f, 4>& area_px) {
    for (std::size_t i = 0; i < area_px.size(); ++i)
        canvas.line(view.to_display(area_px[i]), view.to_display(area_px[(i + 1) % area_px.size()]),
                    1.5f * canvas.scale(), style::white.faded(0.35f));
}

/// Within the view: they may be larger.
void draw_areas(Canvas& canvas, const ViewMapping& view, const std::vector<ShownArea>& areas) {
    canvas.begin_clip(view.rect.min_px, view.rect.max_px);
    for (const ShownArea& area : areas) {
        for (std::size_t i = 0; i < area.corners_px.size(); ++i)
            canvas.line(view.to_display(area.corners_px[i]),
                        view.to_display(area.corners_px[(i + 1) % area.corners_px.size()]),
                        1.5f * canvas.scale(), style::white.faded(0.35f));
    }
    canvas.end_clip();
}

void draw_empty_view(Canvas& canvas, const DisplayRect& rect) {
    canvas.box(rect.min_px, rect.max_px, style::corner_px * canvas.scale(), style::card.faded(0.6f));
}

}  // namespace

struct TablePresenter::Parts {
    explicit Parts(bool projected, ScenePlace place)
        : panel(scene_names(place)), compositor(projected ? SurfaceCompositor(1.f) : SurfaceCompositor()) {}

    std::string scene_name;
    std::unique_ptr<Scene> scene;
    std::optional<TouchMenu> menu;
    OperatorPanel panel;
    IdleWatch idle{0.f};
    AttractScene attract;
    float idle_share = 0.f;         // 0..1 while it comes and goes
    std::set<int> ignored_fingers;  // until they go up
    SurfaceCompositor compositor;
    Canvas canvas;
    CanvasRenderer canvas_renderer;
    FingerMarks fingers;
    SurfaceGeometry surface;
    Layout layout;
    PixelSize view_size{};
    bool scanning = false;
    SplitScene* split = nullptr;  // scene, where the table has several areas
    int versions_before = 0;      // of pictures that scenes before this one wished for
};

TablePresenter::TablePresenter(Display& display, const std::string& scene_name, const PresenterConfig& config)
    : display_(display), config_(config) {
    auto scene = make_scene(scene_name, config.scenes, place());
    parts_ = std::make_unique<Parts>(config.projected, place());
    parts_->scene = std::move(scene);
    parts_->scene_name = scene_name;
    if (config.menu) parts_->menu.emplace(scene_names(place()));
    parts_->idle = IdleWatch(config.attract_after_s);
}

TablePresenter::~TablePresenter() = default;

void TablePresenter::present(const TableFrame& frame, float dt_s) {
    draw(frame, dt_s);
    display_.present();
}

void TablePresenter::draw(const TableFrame& frame, float dt_s) {
    clock_s_ += dt_s;
    take_keys();
    if (frame.index != last_index_ || frame.timestamp_us != last_timestamp_us_) take_in(frame);
    last_index_ = frame.index;
    last_timestamp_us_ = frame.timestamp_us;
    update(dt_s);
    draw_all(frame);
}

void TablePresenter::pause() { lift_all_fingers(); }

SceneWish TablePresenter::wish() const {
    SceneWish wish = parts_->scene->wish();
    if (wish.view) wish.view->version += parts_->versions_before;
    return wish;
}

OperatorWish TablePresenter::operator_wish() const {
    OperatorWish wish = parts_->panel.wish();
    wish.unsaved = parts_->scene->unsaved();
    return wish;
}

const std::string& TablePresenter::scene_name() const { return parts_->scene_name; }

void TablePresenter::take_in(const TableFrame& told) {
    Parts& p = *parts_;
    // What the scene before wished for is not for this one.
    const bool has_old_picture = told.rendered && told.rendered->version < p.versions_before;
    TableFrame without_picture;
    if (has_old_picture) {
        without_picture = told;
        without_picture.rendered = nullptr;
    }
    const TableFrame& frame = has_old_picture ? without_picture : told;
    p.compositor.set_view(frame.view);
    split_table(frame);
    start_scene(frame);
    p.surface = SurfaceGeometry(frame, p.view_size);
    p.scene->show(frame);
    p.attract.show(frame);
    if (p.menu) p.menu->update(frame.timestamp_us);
    const bool slept = p.idle.is_idle();
    p.idle.see(frame);
    for (const TouchEvent& event : frame.touches) {
        if (slept && event.phase == TouchPhase::down) p.ignored_fingers.insert(event.tip.id);
        if (!frame.cross || p.panel.is_open()) deliver(event);
        p.fingers.on_touch(event);
    }
    p.scene->on_hovers(frame.hovers);
    p.fingers.on_hovers(frame.hovers);
    if (is_waiting_state(frame)) lift_all_fingers();
    if (p.panel.update(frame, p.surface)) take_fingers_from_scene();
    if (!p.menu) return;
    if (p.idle.is_idle()) p.menu->close();
    if (const auto chosen = p.menu->update(frame.timestamp_us)) change_scene(*chosen, frame);
}

void TablePresenter::start_scene(const TableFrame& frame) {
    Parts& p = *parts_;
    const PixelSize view_size =
        frame.view ? PixelSize{frame.view->width_px, frame.view->height_px} : p.view_size;
    const bool scanning = frame.state == "scanning";
    const bool scan_begins = scanning && !p.scanning;
    if (view_size != p.view_size || (scan_begins && view_size.width_px > 0)) {
        p.scene->start(view_size);
        p.attract.start(view_size);
    }
    p.view_size = view_size;
    p.scanning = scanning;
}

/// To whom the finger belongs.
void TablePresenter::deliver(const TouchEvent& event) {
    Parts& p = *parts_;
    if (p.ignored_fingers.contains(event.tip.id)) {
        if (event.phase == TouchPhase::up) p.ignored_fingers.erase(event.tip.id);
        return;
    }
    if (!p.panel.on_touch(event)) deliver_to_scene(event);
}

void TablePresenter::deliver_to_scene(const TouchEvent& event) {
    Parts& p = *parts_;
    if (!p.menu || !p.menu->on_touch(event)) p.scene->on_touch(event);
}

/// For the scene they go up, and until they do they are nobody's.
void TablePresenter::take_fingers_from_scene() {
    Parts& p = *parts_;
    for (const auto& [id, tip] : p.fingers.touching()) {
        deliver_to_scene({tip, TouchPhase::up});
        p.ignored_fingers.insert(id);
    }
    if (p.menu) p.menu->close();
}

void TablePresenter::take_keys() {
    while (const std::optional<char> key = display_.take_key())
        if (*key == 'o') parts_->panel.toggle();
}

void TablePresenter::change_scene(const std::string& name, const TableFrame& frame) {
    if (name == parts_->scene_name) return;
    replace_scene([&] { return make_scene(name, config_.scenes, place()); }, frame);
    parts_->scene_name = name;
}

/// The scenes of areas are theirs: there is no menu then.
void TablePresenter::split_table(const TableFrame& frame) {
    Parts& p = *parts_;
    if (p.split != nullptr && !frame.areas.empty()) return p.split->set_areas(frame);
    if (p.split == nullptr && frame.areas.empty()) return;
    const bool is_waiting = frame.areas.empty() && frame.state != "live";
    if (is_waiting) return;
    p.split = nullptr;
    replace_scene(
        [&]() -> std::unique_ptr<Scene> {
            if (frame.areas.empty()) return make_scene(p.scene_name, config_.scenes, place());
            auto split = std::make_unique<SplitScene>(p.scene_name, config_.scenes, place());
            split->set_areas(frame);
            p.split = split.get();
            return split;
        },
        frame);
    p.menu.reset();
    if (config_.menu && p.split == nullptr) p.menu.emplace(scene_names(place()));
}

/// The old scene is gone before the new one is there. Fingers on the surface do nothing in the new one.
void TablePresenter::replace_scene(const std::function<std::unique_ptr<Scene>()>& make,
                                   const TableFrame& frame) {
    Parts& p = *parts_;
    if (const auto view = p.scene->wish().view) p.versions_before += view->version + 1;
    p.scene.reset();
    p.scene = make();
    if (p.view_size.width_px > 0) p.scene->start(p.view_size);
    TableFrame first = frame;
    first.rendered = nullptr;
    p.scene->show(first);
    for (const int id : p.fingers.touching_ids()) p.ignored_fingers.insert(id);
}

/// While nobody can touch, no `up` may come for a finger that was down.
void TablePresenter::lift_all_fingers() {
    Parts& p = *parts_;
    for (const auto& [id, tip] : p.fingers.touching()) deliver({tip, TouchPhase::up});
    p.scene->on_hovers({});
    p.fingers.clear();
    p.ignored_fingers.clear();
    p.panel.cancel();
    if (p.menu) p.menu->close();
}

void TablePresenter::update(float dt_s) {
    Parts& p = *parts_;
    p.scene->update(dt_s);
    const bool attracts = p.idle.is_idle() && !p.panel.is_open() && p.scene_name != "attract";
    p.idle_share += attracts ? dt_s / fall_idle_s : -dt_s / wake_s;
    p.idle_share = std::clamp(p.idle_share, 0.f, 1.f);
    if (p.idle_share > 0.f) p.attract.update(dt_s);
}

void TablePresenter::draw_all(const TableFrame& frame) {
    Parts& p = *parts_;
    display_.begin_frame();
    const PixelSize display = display_.size_px();
    const bool waiting = is_waiting_state(frame);
    const bool has_view = p.compositor.has_view();
    const PixelSize view = has_view ? p.view_size : size_before_first_view;
    p.layout = config_.projected ? make_projected_layout(display, view) : make_layout(display, view);

    const style::Color backdrop = config_.projected ? style::no_light : style::backdrop;
    glClearColor(backdrop.r / 255.f, backdrop.g / 255.f, backdrop.b / 255.f, 1.f);
    glClear(GL_COLOR_BUFFER_BIT);
    const float awake = waiting ? brightness_while_waiting : 1.f;
    if (has_view)
        p.compositor.draw(p.layout, display, p.scene->surface_layer(), p.scene->overlay_layer(),
                          awake + p.idle_share * (brightness_while_idle - awake));
    Canvas& canvas = p.canvas;
    canvas.begin({static_cast<float>(display.width_px), static_cast<float>(display.height_px)},
                 p.layout.scale);
    if (!has_view && !config_.projected) draw_empty_view(canvas, p.layout.view.rect);
    draw_scene(frame);
    if (p.idle_share > 0.f) {
        fade(canvas, 1.f - p.idle_share);
        p.attract.draw(canvas, p.layout.view, p.idle_share);
    }
    if (p.panel.is_open()) p.panel.draw(canvas, p.layout.view, p.surface, frame);
    p.canvas_renderer.draw(canvas);
    if (p.panel.is_open()) p.panel.draw_pictures(display);
}

void TablePresenter::draw_scene(const TableFrame& frame) {
    Parts& p = *parts_;
    const ViewMapping& view = p.layout.view;
    const StatusWords words = status_words(frame, frame.cross ? "Touch the crosses" : p.scene->invitation(),
                                           p.fingers.touching_ids());
    // Under the controls: an open menu is as wide as the view.
    if (config_.projected) draw_status_note(p.canvas, p.layout, words);
    if (!frame.areas.empty() && !config_.projected)
        draw_areas(p.canvas, view, frame.areas);
    else if (frame.has_area && !config_.projected && !p.scene->hides_table())
        draw_area(p.canvas, view, frame.area_px);
    if (is_waiting_state(frame)) {
        draw_scan_progress(p.canvas, view.rect, frame, clock_s_);
    } else if (!p.panel.is_open()) {
        p.scene->draw(p.canvas, view);
        if (p.menu && !frame.cross) p.menu->draw(p.canvas, view, p.surface, p.scene_name);
        p.fingers.draw(p.canvas, view);
        if (frame.cross) draw_cross_guide(p.canvas, view, *frame.cross);
    }
    if (!config_.projected) draw_status_panel(p.canvas, p.layout, words);
}

}  // namespace touchstone
