#include "ui/photo_table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>

namespace touchstone {

namespace {

using Eigen::Rotation2Df;
using Eigen::Vector2f;

constexpr float long_side_mm = 280.f;  // at scale 1
constexpr float least_scale = 0.4f, most_scale = 3.f, enlarged = 2.1f;
constexpr float largest_share = 0.6f;  // of the room's shorter side, for a photo that is put down
constexpr float friction_s = 0.45f;    // speed falls to 1/e
constexpr float still_mm_s = 4.f;
constexpr float spring_s = 0.11f, glide_s = 0.12f;
constexpr float bounce = 0.4f;       // of the speed
constexpr float edge_share = 0.75f;  // of a photo that stays within the edges
constexpr float farthest_turn_rad = 0.22f;

float share_of(float dt_s, float time_s) { return 1.f - std::exp(-dt_s / time_s); }

float upright_near_zero(float rotation_rad) {
    return std::remainder(rotation_rad, 2.f * std::numbers::pi_v<float>);
}

}  // namespace

bool PhotoCard::contains(const Vector2f& place_px) const {
    const Vector2f own = Rotation2Df(-rotation_rad) * (place_px - center_px);
    return (own.cwiseAbs().array() <= (scale * half_px).array()).all();
}

Vector2f PhotoCard::half_box_px() const {
    const float c = std::abs(std::cos(rotation_rad)), s = std::abs(std::sin(rotation_rad));
    return scale * Vector2f(c * half_px.x() + s * half_px.y(), s * half_px.x() + c * half_px.y());
}

void PhotoTable::set_room(const SurfaceRoom& room, float mm_per_px) {
    room_ = room;
    mm_per_px_ = mm_per_px;
}

/// A grid as wide as the room, each photo a little off its place, turned by a little.
int PhotoTable::add(float aspect, int of) {
    PhotoCard card;
    card.id = made_++;
    const float long_px = 0.5f * long_side_mm / mm_per_px_;
    card.half_px = aspect >= 1.f ? Vector2f(long_px, long_px / aspect) : Vector2f(long_px * aspect, long_px);
    const Vector2f sizes_px = room_.box_px().sizes();
    card.scale = std::clamp(largest_share * sizes_px.minCoeff() / (2.f * long_px), least_scale, 1.f);
    const float wide = std::max(1.f, sizes_px.x() / std::max(1.f, sizes_px.y()));
    const int columns = std::max(1, static_cast<int>(std::lround(std::sqrt(static_cast<float>(of) * wide))));
    const int rows = std::max(1, (of + columns - 1) / columns);
    const int slot = card.id % std::max(1, columns * rows);
    const Vector2f share((static_cast<float>(slot % columns) + 0.5f) / static_cast<float>(columns),
                         (static_cast<float>(slot / columns) + 0.5f) / static_cast<float>(rows));
    const auto number = static_cast<float>(card.id + 1);
    const Vector2f off(std::sin(2.399963f * number), std::cos(3.7f * number));
    const float y_px = room_.box_px().min().y() + share.y() * sizes_px.y();
    const Vector2f span_px =
        room_.span_px(y_px).value_or(Vector2f(room_.box_px().min().x(), room_.box_px().max().x()));
    const Vector2f place_px(span_px.x() + share.x() * (span_px.y() - span_px.x()), y_px);
    card.rotation_rad = farthest_turn_rad * std::sin(4.1f * number);
    card.center_px = room_.nearest_px(place_px + 0.18f * card.scale * long_px * off, card.half_box_px());
    cards_.push_back(card);
    changed_ = true;
    return card.id;
}

PhotoCard* PhotoTable::find(int id) {
    const auto found = std::ranges::find(cards_, id, &PhotoCard::id);
    return found == cards_.end() ? nullptr : &*found;
}

std::optional<int> PhotoTable::hit(const Vector2f& place_px) const {
    const auto top = std::find_if(cards_.rbegin(), cards_.rend(),
                                  [&](const PhotoCard& card) { return card.contains(place_px); });
    if (top == cards_.rend()) return std::nullopt;
    return top->id;
}

void PhotoTable::grasp(int id) {
    const auto found = std::ranges::find(cards_, id, &PhotoCard::id);
    if (found == cards_.end()) return;
    found->velocity_px_s.setZero();
    std::rotate(found, found + 1, cards_.end());
    changed_ = true;
}

void PhotoTable::on_gesture(const Gesture& gesture) {
    PhotoCard* const card = gesture.target ? find(*gesture.target) : nullptr;
    if (card == nullptr) return;
    changed_ = true;
    std::visit(
        [&](const auto& what) {
            using What = std::decay_t<decltype(what)>;
            if constexpr (std::is_same_v<What, Drag>) on_drag(*card, what);
            if constexpr (std::is_same_v<What, Transform>) on_transform(*card, what);
            if constexpr (std::is_same_v<What, DoubleTap>) on_double_tap(*card);
            if constexpr (std::is_same_v<What, Swipe>) card->velocity_px_s = what.velocity_px_s;
        },
        gesture.what);
}

void PhotoTable::on_drag(PhotoCard& card, const Drag& drag) {
    card.held = drag.phase != GesturePhase::end;
    card.goal.reset();
    card.velocity_px_s.setZero();
    card.center_px += drag.delta_px;
}

void PhotoTable::on_transform(PhotoCard& card, const Transform& transform) {
    card.held = transform.phase != GesturePhase::end;
    card.goal.reset();
    card.velocity_px_s.setZero();
    card.center_px = transform.delta(card.center_px);
    card.rotation_rad += transform.delta.rotation_rad;
    card.scale = std::clamp(card.scale * transform.delta.scale, least_scale, most_scale);
}

void PhotoTable::on_double_tap(PhotoCard& card) {
    PhotoCard after = card;
    card.rotation_rad = upright_near_zero(card.rotation_rad);
    after.rotation_rad = 0.f;
    after.scale = card.scale < 0.8f * enlarged ? enlarged : 1.f;
    const Vector2f room_half = 0.5f * room_.box_px().sizes();
    const float fits = room_half.cwiseQuotient(after.half_px).minCoeff();
    after.scale = std::min(after.scale, std::max(fits, least_scale));
    card.goal = {room_.nearest_px(card.center_px, after.half_box_px()), 0.f, after.scale};
}

bool PhotoTable::update(float dt_s) {
    const float step_s = std::clamp(dt_s, 0.f, 0.1f);
    for (PhotoCard& card : cards_) {
        if (card.held) continue;
        const Vector2f before = card.center_px;
        if (card.goal) {
            glide(card, step_s);
            changed_ = true;
        } else {
            slide(card, step_s);
        }
        changed_ = changed_ || before != card.center_px;
    }
    return std::exchange(changed_, false);
}

void PhotoTable::glide(PhotoCard& card, float dt_s) const {
    const float share = share_of(dt_s, glide_s);
    card.center_px += share * (card.goal->center_px - card.center_px);
    card.rotation_rad += share * (card.goal->rotation_rad - card.rotation_rad);
    card.scale *= std::pow(card.goal->scale / card.scale, share);
    const bool is_there = (card.goal->center_px - card.center_px).norm() < 0.3f &&
                          std::abs(card.rotation_rad - card.goal->rotation_rad) < 0.003f &&
                          std::abs(card.scale / card.goal->scale - 1.f) < 0.003f;
    if (!is_there) return;
    card.center_px = card.goal->center_px;
    card.rotation_rad = card.goal->rotation_rad;
    card.scale = card.goal->scale;
    card.goal.reset();
}

void PhotoTable::slide(PhotoCard& card, float dt_s) const {
    card.center_px += dt_s * card.velocity_px_s;
    card.velocity_px_s *= 1.f - share_of(dt_s, friction_s);
    if (card.velocity_px_s.norm() * mm_per_px_ < still_mm_s) card.velocity_px_s.setZero();
    const Vector2f inside = room_.nearest_px(card.center_px, edge_share * card.half_box_px());
    const Vector2f back = inside - card.center_px;
    for (const int axis : {0, 1})
        if (back[axis] * card.velocity_px_s[axis] < 0.f) card.velocity_px_s[axis] *= -bounce;
    if (back.norm() < 0.05f)
        card.center_px = inside;
    else
        card.center_px += share_of(dt_s, spring_s) * back;
}

}  // namespace touchstone
