#include "ui/operator_panel.hpp"

#include "ui/operator_card.hpp"
#include "ui/table_frame.hpp"

namespace touchstone {

namespace {

constexpr std::uint64_t stays_open_us = 60'000'000;

Button make_button(OperatorButton what, Icon icon, std::string label, bool is_held) {
    Button button;
    button.id = static_cast<int>(what);
    button.icon = icon;
    button.label = std::move(label);
    button.is_held = is_held;
    return button;
}

}  // namespace

OperatorPanel::OperatorPanel() { row_.set(buttons()); }

/// What cannot be undone is held.
std::vector<Button> OperatorPanel::buttons() const {
    std::vector<Button> all{make_button(OperatorButton::rescan, Icon::rescan, "Scan anew", true),
                            make_button(OperatorButton::recalibrate, Icon::cross, "Calibrate touch", true)};
    if (view_ && view_->can_calibrate_projector)
        all.push_back(
            make_button(OperatorButton::calibrate_projector, Icon::projector, "Calibrate projector", true));
    Button& record =
        all.emplace_back(make_button(OperatorButton::record, Icon::record, "Record 10 s", false));
    record.color = style::bad;
    record.enabled = view_ && view_->can_record;
    all.emplace_back(make_button(OperatorButton::close, Icon::close, "Close", false)).gap_before = true;
    return all;
}

bool OperatorPanel::on_touch(const TouchEvent& event) {
    corner_press_.on_touch(event);
    const bool known = fingers_.contains(event.tip.id);
    if (!is_open() && !known) return false;
    if (event.phase == TouchPhase::down) {
        fingers_.insert(event.tip.id);
        touched_us_ = now_us_;
    }
    row_.on_touch(event);
    if (event.phase == TouchPhase::up) fingers_.erase(event.tip.id);
    return true;
}

bool OperatorPanel::update(const TableFrame& frame, const SurfaceGeometry& surface) {
    now_us_ = frame.timestamp_us;
    touched_us_ = std::min(touched_us_, now_us_);
    if (frame.operating && frame.operating != view_) {
        view_ = frame.operating;
        depth_.set(view_->depth);
        mask_.set(view_->mask);
    }
    for (const int id : row_.update(now_us_)) press(static_cast<OperatorButton>(id));
    if (is_open() && now_us_ - touched_us_ > stays_open_us) wish_.open = false;
    const bool opens = corner_press_.update(frame, surface) && !is_open();
    if (opens) open(now_us_);
    return opens;
}

void OperatorPanel::press(OperatorButton button) {
    switch (button) {
        case OperatorButton::rescan:
            ++wish_.rescans;
            break;
        case OperatorButton::recalibrate:
            ++wish_.recalibrations;
            wish_.open = false;
            break;
        case OperatorButton::calibrate_projector:
            ++wish_.projector_calibrations;
            wish_.open = false;
            break;
        case OperatorButton::record:
            ++wish_.recordings;
            break;
        case OperatorButton::close:
            wish_.open = false;
            break;
    }
}

void OperatorPanel::open(std::uint64_t now_us) {
    wish_.open = true;
    touched_us_ = now_us;
}

void OperatorPanel::toggle() {
    if (is_open())
        wish_.open = false;
    else
        open(now_us_);
}

void OperatorPanel::cancel() {
    corner_press_.cancel();
    row_.cancel();
    fingers_.clear();
}

void OperatorPanel::draw(Canvas& canvas, const ViewMapping& view, const SurfaceGeometry& surface,
                         const TableFrame& frame) {
    row_.set(buttons());
    row_.lay_out(canvas, view, surface);
    const float margin = 0.5f * style::margin_px * canvas.scale();
    const Eigen::Vector2f room_min = view.rect.min_px + Eigen::Vector2f(margin, margin);
    const float bottom = view.to_display(row_.card_px().min()).y() - margin;
    const OperatorCardLayout layout{{room_min, {view.rect.max_px.x() - margin, bottom}}};
    draw_operator_card(canvas, layout, frame, view_ ? *view_ : OperatorView());
    depth_box_ = layout.depth_box(canvas.scale());
    mask_box_ = layout.mask_box(canvas.scale());
    row_.draw(canvas, view);
}

void OperatorPanel::draw_pictures(PixelSize display) const {
    depth_.draw(depth_box_, display);
    mask_.draw(mask_box_, display);
}

Eigen::AlignedBox2f OperatorPanel::place_px(OperatorButton button) const {
    return row_.place_px(static_cast<int>(button));
}

}  // namespace touchstone
