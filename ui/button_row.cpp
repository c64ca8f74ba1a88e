#include "ui/button_row.hpp"

#include <algorithm>
#include <utility>

namespace touchstone {

namespace {

using Eigen::AlignedBox2f;
using Eigen::Vector2f;

constexpr float least_px = 38.f;                                                    // on the display
constexpr float gap_share = 0.18f, group_gap_share = 0.42f, padding_share = 0.18f;  // of a button's side
constexpr float icon_share = 0.54f;
constexpr float label_room_px = 8.f, label_gap_px = 3.f;
/// A touch that drops out and comes back within it is no second press.
constexpr std::uint64_t bridge_us = 100'000;
constexpr std::uint64_t afterglow_us = 150'000;

/// Lengths of a row, in pixels of the depth picture.
struct RowSizes {
    float width, height, gap, group_gap, padding;

    float total(const std::vector<Button>& buttons) const {
        float sum = 2.f * padding;
        for (std::size_t i = 0; i < buttons.size(); ++i)
            sum += width + (i == 0 ? 0.f : buttons[i].gap_before ? group_gap : gap);
        return sum;
    }
};

RowSizes row_sizes(float side, float width, float height) {
    return {width, height, gap_share * side, group_gap_share * side, padding_share * side};
}

Vector2f widest_label_px(const Canvas& canvas, const std::vector<Button>& buttons) {
    Vector2f widest(0.f, 0.f);
    for (const Button& button : buttons)
        if (!button.label.empty())
            widest = widest.cwiseMax(canvas.text_size_px(TextStyle::caption, button.label));
    return widest;
}

DisplayRect on_display(const ViewMapping& view, const AlignedBox2f& box) {
    return {view.to_display(box.min()), view.to_display(box.max())};
}

}  // namespace

void ButtonRow::lay_out(const Canvas& canvas, const ViewMapping& view, const SurfaceGeometry& surface) {
    const auto box_of = [&](float height) {
        return edge_ == RowEdge::top ? surface.top_row(height) : surface.bottom_row(height);
    };
    const float s = canvas.scale(), per_px = 1.f / view.display_px_per_px;
    const float mm_per_px = surface.mm_per_px(box_of(1.f).center());
    const float wanted = std::max(button_mm / mm_per_px, least_px * s * per_px);
    label_height_px_ = widest_label_px(canvas, buttons_).y();
    const Vector2f label = widest_label_px(canvas, buttons_) * per_px;
    RowSizes sizes = row_sizes(wanted, std::max(wanted, label.x() + 2.f * label_room_px * s * per_px),
                               wanted + label.y() + label_gap_px * s * per_px);
    const auto room = [&] { return box_of(sizes.height + 2.f * sizes.padding).sizes().x(); };
    shows_labels_ = label.y() > 0.f && sizes.total(buttons_) <= room();
    if (!shows_labels_) {
        sizes = row_sizes(wanted, wanted, wanted);
        const float shrunk = std::min(1.f, room() / sizes.total(buttons_)) * wanted;
        const float side = std::max(shrunk, least_button_mm / mm_per_px);
        sizes = row_sizes(side, side, side);
    }
    const AlignedBox2f row = box_of(sizes.height + 2.f * sizes.padding);
    const float total = sizes.total(buttons_);
    card_px_ = {Vector2f(row.center().x() - 0.5f * total, row.min().y()),
                Vector2f(row.center().x() + 0.5f * total, row.max().y())};
    places_px_.clear();
    Vector2f at = card_px_.min() + Vector2f(sizes.padding, sizes.padding);
    for (std::size_t i = 0; i < buttons_.size(); ++i) {
        if (i > 0) at.x() += buttons_[i].gap_before ? sizes.group_gap : sizes.gap;
        places_px_.emplace_back(at, at + Vector2f(sizes.width, sizes.height));
        at.x() += sizes.width;
    }
}

bool ButtonRow::on_touch(const TouchEvent& event) {
    const auto finger = fingers_.find(event.tip.id);
    if (event.phase != TouchPhase::down) {
        if (finger == fingers_.end()) return false;
        if (event.phase == TouchPhase::up) {
            left_us_[finger->second.button] = now_us_;
            fingers_.erase(finger);
        }
        return true;
    }
    if (places_px_.size() != buttons_.size() || !card_px_.contains(event.tip.pixel_px)) return false;
    int nearest = -1;
    for (std::size_t i = 0; i < buttons_.size(); ++i) {
        // The gaps between buttons belong to them.
        const AlignedBox2f& place = places_px_[i];
        const float reach = 0.5f * gap_share * place.sizes().y();
        if (place.exteriorDistance(event.tip.pixel_px) <= reach) nearest = static_cast<int>(i);
    }
    Finger down{-1, now_us_, true};
    if (nearest >= 0 && buttons_[static_cast<std::size_t>(nearest)].enabled) {
        const Button& button = buttons_[static_cast<std::size_t>(nearest)];
        const auto left = left_us_.find(button.id);
        const bool came_back = left != left_us_.end() && now_us_ < left->second + bridge_us && now_us_ > 0;
        down = {button.id, now_us_, !button.is_held};
        if (!button.is_held && !came_back) pressed_.push_back(button.id);
    }
    fingers_.insert_or_assign(event.tip.id, down);
    return true;
}

std::vector<int> ButtonRow::update(std::uint64_t now_us) {
    now_us_ = now_us;
    for (auto& [id, finger] : fingers_) {
        finger.since_us = std::min(finger.since_us, now_us);
        if (finger.told || now_us - finger.since_us < button_hold_us) continue;
        finger.told = true;
        pressed_.push_back(finger.button);
    }
    return std::exchange(pressed_, {});
}

float ButtonRow::held_share(int id) const {
    for (const auto& [finger_id, finger] : fingers_)
        if (finger.button == id && !finger.told)
            return std::min(1.f, static_cast<float>(now_us_ - finger.since_us) / button_hold_us);
    return 0.f;
}

AlignedBox2f ButtonRow::place_px(int id) const {
    for (std::size_t i = 0; i < places_px_.size() && i < buttons_.size(); ++i)
        if (buttons_[i].id == id) return places_px_[i];
    return {};
}

void ButtonRow::draw(Canvas& canvas, const ViewMapping& view) const {
    if (places_px_.size() != buttons_.size() || buttons_.empty()) return;
    const DisplayRect card = on_display(view, card_px_);
    const Vector2f border = Vector2f::Constant(canvas.scale());
    const float corner = style::corner_px * canvas.scale();
    canvas.box(card.min_px - border, card.max_px + border, corner, style::rule);
    canvas.box(card.min_px, card.max_px, corner, style::card);
    for (std::size_t i = 0; i < buttons_.size(); ++i) draw_button(canvas, view, buttons_[i], places_px_[i]);
}

void ButtonRow::draw_button(Canvas& canvas, const ViewMapping& view, const Button& button,
                            const AlignedBox2f& place) const {
    const DisplayRect rect = on_display(view, place);
    const float s = canvas.scale(), corner = 0.7f * style::corner_px * s;
    const auto left = left_us_.find(button.id);
    const bool glows = left != left_us_.end() && now_us_ < left->second + afterglow_us;
    const bool pressed = glows || std::any_of(fingers_.begin(), fingers_.end(), [&](const auto& each) {
                             return each.second.button == button.id;
                         });
    if (button.selected) canvas.box(rect.min_px, rect.max_px, corner, style::white.faded(0.16f));
    if (pressed) canvas.box(rect.min_px, rect.max_px, corner, style::accent.faded(0.45f));
    const Vector2f label = canvas.text_size_px(TextStyle::caption, button.label);
    const float icon_room = rect.size_px().y() - (shows_labels_ ? label_height_px_ + label_gap_px * s : 0.f);
    const Vector2f center(rect.center_px().x(), rect.min_px.y() + 0.5f * icon_room);
    const float opacity = button.enabled ? 1.f : 0.3f;
    draw_icon(canvas, button.icon, center, icon_share * icon_room, button.color.faded(opacity), button.fill);
    if (button.selected) {
        const float half = 0.3f * rect.size_px().x(), y = rect.max_px.y() - 1.5f * s;
        canvas.line({center.x() - half, y}, {center.x() + half, y}, 3.f * s, style::accent);
    }
    if (const float share = held_share(button.id); share > 0.f)
        canvas.arc(center, 0.43f * icon_room, style::ring_px * s, 0.f, share, style::white);
    if (!shows_labels_) return;
    canvas.text(TextStyle::caption,
                {center.x() - 0.5f * label.x(), rect.max_px.y() - label_height_px_ - 4.f * s},
                style::text.faded(opacity), button.label);
}

}  // namespace touchstone
