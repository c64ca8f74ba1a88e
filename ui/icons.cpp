#include "ui/icons.hpp"

#include <array>
#include <cmath>
#include <imgui.h>
#include <numbers>
#include <span>
#include <utility>

namespace touchstone {

namespace {

using Eigen::Vector2f;

/// A unit square about the icon's middle, y down, as a place to draw in.
struct Pen {
    Canvas& canvas;
    Vector2f center_px;
    float side_px;
    style::Color color;
    float width_px = std::max(1.5f, 0.085f * side_px);

    Vector2f at(float x, float y) const { return center_px + side_px * Vector2f(x, y); }
    void line(Vector2f a, Vector2f b) const {
        canvas.line(at(a.x(), a.y()), at(b.x(), b.y()), width_px, color);
    }
    void disc(float x, float y, float radius) const { canvas.disc(at(x, y), radius * side_px, color); }
    void ring(float x, float y, float radius) const {
        canvas.ring(at(x, y), radius * side_px, width_px, color);
    }
    void arc(float x, float y, float radius, float from_turn, float to_turn) const {
        canvas.arc(at(x, y), radius * side_px, width_px, from_turn, to_turn, color);
    }
    void path(std::span<const Vector2f> points, bool closed) const {
        for (const Vector2f& p : points)
            canvas.list().PathLineTo({at(p.x(), p.y()).x(), at(p.x(), p.y()).y()});
        canvas.list().PathStroke(color.packed(), closed ? ImDrawFlags_Closed : ImDrawFlags_None, width_px);
    }
    void fill(std::span<const Vector2f> points) const {
        for (const Vector2f& p : points)
            canvas.list().PathLineTo({at(p.x(), p.y()).x(), at(p.x(), p.y()).y()});
        canvas.list().PathFillConvex(color.packed());
    }
};

void draw_menu(const Pen& pen) {
    for (const float x : {-0.22f, 0.22f})
        for (const float y : {-0.22f, 0.22f}) pen.disc(x, y, 0.15f);
}

void draw_paint(const Pen& pen) {
    const std::array handle{Vector2f(0.38f, -0.46f), Vector2f(0.46f, -0.38f), Vector2f(0.04f, 0.16f),
                            Vector2f(-0.12f, 0.f)};
    pen.fill(handle);
    const std::array bristles{Vector2f(-0.18f, 0.06f), Vector2f(-0.02f, 0.22f), Vector2f(-0.12f, 0.38f),
                              Vector2f(-0.44f, 0.44f), Vector2f(-0.36f, 0.18f)};
    pen.fill(bristles);
}

void draw_particles(const Pen& pen) {
    for (const Vector2f& p : {Vector2f(-0.28f, 0.3f), Vector2f(0.02f, 0.3f), Vector2f(0.32f, 0.3f),
                              Vector2f(-0.13f, 0.03f), Vector2f(0.17f, 0.03f), Vector2f(0.02f, -0.36f)})
        pen.disc(p.x(), p.y(), 0.135f);
}

void draw_mirror(const Pen& pen) {
    pen.ring(0.f, 0.f, 0.42f);
    pen.arc(0.f, 0.f, 0.25f, 0.72f, 0.95f);
}

void draw_photos(const Pen& pen) {
    const std::array frame{Vector2f(-0.45f, -0.36f), Vector2f(0.45f, -0.36f), Vector2f(0.45f, 0.36f),
                           Vector2f(-0.45f, 0.36f)};
    pen.path(frame, true);
    const std::array hill{Vector2f(-0.38f, 0.3f), Vector2f(-0.1f, -0.08f), Vector2f(0.22f, 0.3f)};
    pen.fill(hill);
    const std::array second{Vector2f(0.f, 0.3f), Vector2f(0.2f, 0.06f), Vector2f(0.38f, 0.3f)};
    pen.fill(second);
    pen.disc(0.21f, -0.14f, 0.09f);
}

/// A cube seen from above its corner.
void draw_inspect(const Pen& pen) {
    const std::array outline{Vector2f(0.f, -0.46f), Vector2f(0.4f, -0.23f), Vector2f(0.4f, 0.23f),
                             Vector2f(0.f, 0.46f),  Vector2f(-0.4f, 0.23f), Vector2f(-0.4f, -0.23f)};
    pen.path(outline, true);
    for (const Vector2f& corner : {Vector2f(0.f, 0.46f), Vector2f(0.4f, -0.23f), Vector2f(-0.4f, -0.23f)})
        pen.line({0.f, 0.f}, corner);
}

void draw_attract(const Pen& pen) {
    pen.disc(0.f, 0.f, 0.12f);
    pen.ring(0.f, 0.f, 0.27f);
    pen.ring(0.f, 0.f, 0.44f);
}

void draw_each_finger(Pen pen) {
    for (std::size_t i = 0; i < 5; ++i) {
        pen.color = style::palette[std::array<std::size_t, 5>{0, 2, 3, 1, 4}[i]];
        const float turn = 2.f * std::numbers::pi_v<float> * (static_cast<float>(i) / 5.f - 0.25f);
        pen.disc(0.3f * std::cos(turn), 0.3f * std::sin(turn), 0.17f);
    }
}

void draw_eraser(const Pen& pen) {
    const std::array block{Vector2f(0.1f, -0.42f), Vector2f(0.42f, -0.1f), Vector2f(-0.06f, 0.38f),
                           Vector2f(-0.38f, 0.06f)};
    pen.path(block, true);
    const std::array used{Vector2f(-0.16f, -0.16f), Vector2f(0.16f, 0.16f), Vector2f(-0.06f, 0.38f),
                          Vector2f(-0.38f, 0.06f)};
    pen.fill(used);
    pen.line({-0.02f, 0.44f}, {0.44f, 0.44f});
}

void draw_undo(const Pen& pen) {
    pen.arc(0.04f, 0.08f, 0.32f, -0.2f, 0.5f);
    const std::array head{Vector2f(-0.46f, 0.06f), Vector2f(-0.26f, -0.34f), Vector2f(-0.02f, 0.04f)};
    pen.fill(head);
}

/// A circle that begins again.
void draw_rescan(const Pen& pen) {
    pen.arc(0.f, 0.f, 0.34f, 0.1f, 0.92f);
    const std::array head{Vector2f(-0.02f, -0.34f), Vector2f(-0.26f, -0.48f), Vector2f(-0.24f, -0.12f)};
    pen.fill(head);
}

/// The mark that calibration asks to touch.
/// A box that throws light on a surface under it.
void draw_projector(const Pen& pen) {
    const std::array box{Vector2f(-0.22f, -0.44f), Vector2f(0.22f, -0.44f), Vector2f(0.22f, -0.18f),
                         Vector2f(-0.22f, -0.18f)};
    pen.fill(box);
    pen.line({-0.12f, -0.06f}, {-0.32f, 0.28f});
    pen.line({0.12f, -0.06f}, {0.32f, 0.28f});
    pen.line({-0.46f, 0.4f}, {0.46f, 0.4f});
}

void draw_cross(const Pen& pen) {
    pen.ring(0.f, 0.f, 0.3f);
    pen.line({-0.46f, 0.f}, {0.46f, 0.f});
    pen.line({0.f, -0.46f}, {0.f, 0.46f});
}

void draw_record(const Pen& pen) {
    pen.ring(0.f, 0.f, 0.42f);
    pen.disc(0.f, 0.f, 0.24f);
}

void draw_close(const Pen& pen) {
    pen.line({-0.3f, -0.3f}, {0.3f, 0.3f});
    pen.line({-0.3f, 0.3f}, {0.3f, -0.3f});
}

void draw_clear(const Pen& pen) {
    const std::array bin{Vector2f(-0.3f, -0.24f), Vector2f(-0.24f, 0.45f), Vector2f(0.24f, 0.45f),
                         Vector2f(0.3f, -0.24f)};
    pen.path(bin, false);
    pen.line({-0.44f, -0.26f}, {0.44f, -0.26f});
    pen.line({-0.14f, -0.42f}, {0.14f, -0.42f});
    for (const float x : {-0.09f, 0.09f}) pen.line({x, -0.08f}, {x, 0.28f});
}

void draw_shaded(const Pen& pen) {
    pen.disc(0.f, 0.f, 0.42f);
    Pen shine = pen;
    shine.color = style::card;
    shine.arc(0.f, 0.f, 0.26f, 0.72f, 0.95f);
}

/// Arrows that stand on a curved surface.
void draw_normals(const Pen& pen) {
    pen.arc(0.f, 0.62f, 0.56f, -0.14f, 0.14f);
    for (const float turn : {-0.11f, 0.f, 0.11f}) {
        const float angle = 2.f * std::numbers::pi_v<float> * turn;
        const Vector2f out(std::sin(angle), -std::cos(angle)), across(-out.y(), out.x());
        const Vector2f foot = Vector2f(0.f, 0.62f) + 0.6f * out, tip = foot + 0.46f * out;
        pen.line(foot, tip);
        const std::array head{Vector2f(tip + 0.06f * out), Vector2f(tip - 0.12f * out + 0.12f * across),
                              Vector2f(tip - 0.12f * out - 0.12f * across)};
        pen.fill(head);
    }
}

void draw_hand(const Pen& pen) {
    Pen thick = pen;
    thick.width_px *= 1.5f;
    const std::array tips{Vector2f(-0.22f, -0.26f), Vector2f(-0.05f, -0.42f), Vector2f(0.12f, -0.38f),
                          Vector2f(0.28f, -0.2f)};
    for (const Vector2f& tip : tips) {
        const Vector2f root(0.75f * tip.x(), 0.12f);
        thick.line(root, tip);
        thick.disc(tip.x(), tip.y(), 0.062f);
    }
    thick.line({-0.1f, 0.3f}, {-0.4f, 0.06f});
    thick.disc(-0.4f, 0.06f, 0.062f);
    pen.disc(0.02f, 0.24f, 0.24f);
}

}  // namespace

Icon scene_icon(std::string_view scene_name) {
    constexpr std::array<std::pair<std::string_view, Icon>, 6> icons{{{"paint", Icon::paint},
                                                                      {"particles", Icon::particles},
                                                                      {"mirror", Icon::mirror},
                                                                      {"photos", Icon::photos},
                                                                      {"inspect", Icon::inspect},
                                                                      {"attract", Icon::attract}}};
    for (const auto& [name, icon] : icons)
        if (name == scene_name) return icon;
    return Icon::scene;
}

void draw_icon(Canvas& canvas, Icon icon, const Vector2f& center_px, float side_px, style::Color color,
               float fill) {
    const Pen pen{canvas, center_px, side_px, color};
    switch (icon) {
        case Icon::menu:
            return draw_menu(pen);
        case Icon::paint:
            return draw_paint(pen);
        case Icon::particles:
            return draw_particles(pen);
        case Icon::mirror:
            return draw_mirror(pen);
        case Icon::photos:
            return draw_photos(pen);
        case Icon::inspect:
            return draw_inspect(pen);
        case Icon::attract:
            return draw_attract(pen);
        case Icon::scene:
            return pen.ring(0.f, 0.f, 0.3f);
        case Icon::each_finger:
            return draw_each_finger(pen);
        case Icon::colour:
        case Icon::width:
            return pen.disc(0.f, 0.f, 0.5f * fill);
        case Icon::eraser:
            return draw_eraser(pen);
        case Icon::undo:
            return draw_undo(pen);
        case Icon::clear:
            return draw_clear(pen);
        case Icon::shaded:
            return draw_shaded(pen);
        case Icon::normals:
            return draw_normals(pen);
        case Icon::hand:
            return draw_hand(pen);
        case Icon::rescan:
            return draw_rescan(pen);
        case Icon::cross:
            return draw_cross(pen);
        case Icon::projector:
            return draw_projector(pen);
        case Icon::record:
            return draw_record(pen);
        case Icon::close:
            return draw_close(pen);
    }
}

}  // namespace touchstone
