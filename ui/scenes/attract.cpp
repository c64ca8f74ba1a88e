#include "ui/scenes/attract.hpp"

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <numbers>

namespace touchstone {

namespace {

using Eigen::Vector2f;

constexpr float ring_life_s = 7.f, between_rings_s = 1.3f;
constexpr float ring_reach_mm = 190.f, ring_width_mm = 9.f;
constexpr int waves = 2;             // of a ring, one in another
constexpr float wave_delay = 0.14f;  // of its life
constexpr float words_life_s = 9.f, words_fade_s = 2.f;
constexpr int ring_corners = 56;  // as few as look round: a software GL pays for each
constexpr std::size_t most_rings = 40;
constexpr const char* words = "Touch me";

/// 0..1, far apart for numbers that follow each other.
float scattered(std::uint64_t number, std::uint64_t stream) {
    std::uint64_t x = (number + 1) * 0x9E3779B97F4A7C15ULL + stream * 0xD1B54A32D192ED03ULL;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
    return static_cast<float>((x ^ (x >> 31)) >> 40) / 16777216.f;
}

/// Rises and falls without a corner: 0 at both ends.
float swell(float share) {
    const float s = std::sin(std::numbers::pi_v<float> * std::clamp(share, 0.f, 1.f));
    return s * s;
}

}  // namespace

void AttractScene::show(const TableFrame& frame) { surface_ = SurfaceGeometry(frame, view_); }

Vector2f AttractScene::place_px(std::uint64_t number, float margin_mm) const {
    const Eigen::AlignedBox2f room = surface_.room().box_px();
    const float margin_px = margin_mm / surface_.mm_per_px(room.center());
    const Vector2f margin = Vector2f::Constant(margin_px).cwiseMin(0.4f * room.sizes());
    const Vector2f share(scattered(number, 1), scattered(number, 2));
    return room.min() + margin + share.cwiseProduct(room.sizes() - 2.f * margin);
}

void AttractScene::add_ring(const Vector2f& center_px, style::Color color) {
    if (rings_.size() >= most_rings) rings_.erase(rings_.begin());
    rings_.push_back({center_px, 0.f, color});
}

void AttractScene::on_touch(const TouchEvent& event) {
    if (event.phase == TouchPhase::down) add_ring(event.tip.pixel_px, style::finger_color(event.tip.id));
}

void AttractScene::update(float dt_s) {
    const float step_s = std::clamp(dt_s, 0.f, 0.25f);
    for (Ring& ring : rings_) ring.age_s += step_s;
    std::erase_if(rings_, [](const Ring& ring) { return ring.age_s >= ring_life_s; });
    to_next_ring_s_ -= step_s;
    if (to_next_ring_s_ <= 0.f) {
        add_ring(place_px(rings_made_, 60.f), style::finger_color(static_cast<int>(rings_made_ % 8)));
        to_next_ring_s_ = between_rings_s * (0.6f + 0.8f * scattered(rings_made_, 3));
        ++rings_made_;
    }
    words_age_s_ += step_s;
    if (words_age_s_ < words_life_s) return;
    words_age_s_ = 0.f;
    ++words_made_;
}

void AttractScene::draw(Canvas& canvas, const ViewMapping& view, float opacity) const {
    const Vector2f low = view.rect.min_px, high = view.rect.max_px;
    canvas.list().PushClipRect({low.x(), low.y()}, {high.x(), high.y()});
    for (const Ring& ring : rings_) draw_ring(canvas, view, ring, opacity);
    draw_words(canvas, view, opacity);
    canvas.list().PopClipRect();
}

void AttractScene::draw_ring(Canvas& canvas, const ViewMapping& view, const Ring& ring, float opacity) const {
    const float px_per_mm = view.display_px_per_px / surface_.mm_per_px(ring.center_px);
    const Vector2f center = view.to_display(ring.center_px);
    for (int wave = 0; wave < waves; ++wave) {
        const float start = wave_delay * static_cast<float>(wave);
        const float share = (ring.age_s / ring_life_s - start) / (1.f - wave_delay * (waves - 1));
        if (share <= 0.f || share >= 1.f) continue;
        const float radius = ring_reach_mm * px_per_mm * (1.f - (1.f - share) * (1.f - share));
        const float fade = std::min(1.f, share / 0.12f) * (1.f - share) * (1.f - share);
        const float width = ring_width_mm * px_per_mm * (1.f - 0.6f * share);
        const auto ring_of = [&](float width_px, float opaque) {
            canvas.list().AddCircle({center.x(), center.y()}, radius,
                                    ring.color.faded(opaque * fade * opacity).packed(), ring_corners,
                                    width_px);
        };
        if (wave == 0) ring_of(2.6f * width, 0.18f);
        ring_of(width, 0.85f);
    }
}

void AttractScene::draw_words(Canvas& canvas, const ViewMapping& view, float opacity) const {
    const float share = words_age_s_ / words_life_s;
    const float edge = std::min(words_age_s_, words_life_s - words_age_s_) / words_fade_s;
    const float fade = opacity * swell(0.5f * std::min(edge, 1.f));
    const float s = canvas.scale();
    const Vector2f size = canvas.text_size_px(TextStyle::figure, words);
    const float mark_px = 26.f * s;
    const Vector2f half(0.5f * size.x() + 20.f * s, 0.5f * size.y() + 1.6f * mark_px);
    const Vector2f low = view.to_display(surface_.room().box_px().min()) + half;
    const Vector2f high = view.to_display(surface_.room().box_px().max()) - half;
    const Vector2f at(scattered(words_made_, 4), scattered(words_made_, 5));
    const Vector2f center =
        low + at.cwiseProduct((high - low).cwiseMax(0.f)) - Vector2f(0.f, 6.f * s * share);
    const Vector2f mark = center - Vector2f(0.f, 0.5f * size.y() + 0.4f * mark_px);
    const float beat = std::fmod(2.f * words_age_s_ / 3.f, 1.f);
    canvas.ring(mark, mark_px * (0.4f + 0.6f * beat), 2.5f * s,
                style::white.faded(fade * swell(0.5f + 0.5f * beat)));
    canvas.disc(mark, 0.42f * mark_px, style::white.faded(fade));
    canvas.text(TextStyle::figure, center - Vector2f(0.5f * size.x(), 0.1f * size.y()),
                style::white.faded(fade), words);
}

}  // namespace touchstone
