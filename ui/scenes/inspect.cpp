#include "ui/scenes/inspect.hpp"

#include <algorithm>
#include <array>

#include "ui/table_frame.hpp"

namespace touchstone {

namespace {

struct StyleRow {
    ViewStyle style;
    Icon icon;
    const char* label;
};

/// In the order of the buttons, which have these ids.
constexpr std::array styles{StyleRow{ViewStyle::shaded, Icon::shaded, "Shaded"},
                            StyleRow{ViewStyle::normals, Icon::normals, "Normals"},
                            StyleRow{ViewStyle::colors, Icon::each_finger, "Colours"},
                            StyleRow{ViewStyle::foreground, Icon::hand, "Hands"}};

}  // namespace

InspectScene::InspectScene() { set_buttons(); }

void InspectScene::set_buttons() {
    std::vector<Button> buttons;
    for (std::size_t i = 0; i < styles.size(); ++i) {
        Button button;
        button.id = static_cast<int>(i);
        button.icon = styles[i].icon;
        button.label = styles[i].label;
        button.selected = styles[i].style == style_;
        button.enabled = styles[i].style != ViewStyle::colors || has_colors_;
        buttons.push_back(button);
    }
    styles_.set(std::move(buttons));
}

void InspectScene::start(PixelSize view) {
    view_ = view;
    orbit_.reset();
    gestures_.reset();
    picture_.forget();
}

void InspectScene::show(const TableFrame& frame) {
    now_us_ = frame.timestamp_us;
    surface_ = SurfaceGeometry(frame, view_);
    if (frame.state != "live" || !frame.has_area) return;
    if (!orbit_) {
        orbit_.emplace(frame);
        GestureConfig config;
        config.mm_per_px = surface_.mm_per_px(surface_.room().box_px().center());
        config.join_mm = 1000.f;  // there is one thing to turn: all fingers are of one gesture
        gestures_.emplace(config);
        picture_.change();
    }
    picture_.show(frame);
    if (picture_.view() == nullptr || has_colors_ == picture_.view()->has_colors) return;
    has_colors_ = picture_.view()->has_colors;
    set_buttons();
}

void InspectScene::on_touch(const TouchEvent& event) {
    if (styles_.on_touch(event) || !gestures_) return;
    gestures_->on_touch(event, now_us_);
}

void InspectScene::follow(const Gesture& gesture) {
    if (const auto* drag = std::get_if<Drag>(&gesture.what); drag && drag->phase != GesturePhase::end)
        orbit_->turn(drag->delta_px);
    else if (const auto* moved = std::get_if<Transform>(&gesture.what);
             moved && moved->phase != GesturePhase::end && gesture.fingers == 2)
        orbit_->transform(moved->delta);
    else if (moved && moved->phase != GesturePhase::end)
        orbit_->move(moved->delta.translation_px);
    else if (std::holds_alternative<DoubleTap>(gesture.what))
        orbit_->reset();
    else
        return;
    picture_.change();
}

void InspectScene::update(float dt_s) {
    picture_.pass_time(dt_s);
    for (const int id : styles_.update(now_us_)) {
        style_ = styles[static_cast<std::size_t>(id)].style;
        set_buttons();
        picture_.change();
    }
    if (!gestures_) return;
    for (const Gesture& gesture : gestures_->update(now_us_)) follow(gesture);
}

SceneWish InspectScene::wish() const {
    SceneWish wish;
    if (!orbit_) return wish;
    wish.view = picture_.wish();
    wish.view->T_g_v = orbit_->T_g_v();
    wish.view->style = style_;
    return wish;
}

void InspectScene::draw(Canvas& canvas, const ViewMapping& view) {
    styles_.lay_out(canvas, view, surface_);
    styles_.draw(canvas, view);
}

}  // namespace touchstone
