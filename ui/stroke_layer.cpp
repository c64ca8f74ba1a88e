#include "ui/stroke_layer.hpp"

#include <algorithm>
#include <cmath>

#include "ui/shader.hpp"

namespace touchstone {

namespace {

constexpr int layer_px_per_view_px = 2;
constexpr float radius_step_px = 0.25f;  // so that few calls draw many strokes
constexpr float least_radius_px = 1.f;

float to_layer(float view_px) { return (view_px + 0.5f) * layer_px_per_view_px; }

}  // namespace

StrokeLayer::StrokeLayer(PixelSize view)
    : program_(make_program("stroke")),
      picture_({view.width_px * layer_px_per_view_px, view.height_px * layer_px_per_view_px}) {
    const PixelSize size = picture_.size_px();
    program_.use();
    glUniform2f(program_.uniform("u_layer_size_px"), static_cast<float>(size.width_px),
                static_cast<float>(size.height_px));
    clear();
}

void StrokeLayer::clear() {
    waiting_.clear();
    picture_.bind();
    glClearColor(0.f, 0.f, 0.f, 0.f);
    glClear(GL_COLOR_BUFFER_BIT);
}

void StrokeLayer::add(std::span<const StrokePiece> pieces, const StrokeLook& look) {
    if (pieces.empty()) return;
    const float radius_px = std::max(
        std::round(look.radius_px * layer_px_per_view_px / radius_step_px) * radius_step_px, least_radius_px);
    if (waiting_.empty() || waiting_.back().radius_px != radius_px || waiting_.back().erases != look.erases)
        waiting_.push_back({radius_px, look.erases, {}});
    for (const StrokePiece& piece : pieces)
        waiting_.back().pieces.push_back({{to_layer(piece.a_px.x()), to_layer(piece.a_px.y()),
                                           to_layer(piece.b_px.x()), to_layer(piece.b_px.y())},
                                          look.color.packed()});
}

void StrokeLayer::flush() {
    if (waiting_.empty()) return;
    picture_.bind();
    program_.use();
    const GLint radius = program_.uniform("u_radius_px");
    for (const Batch& batch : waiting_) {
        glUniform1f(radius, batch.radius_px);
        quads_.draw(batch.pieces, batch.erases ? QuadBlend::erase : QuadBlend::over);
    }
    waiting_.clear();
}

}  // namespace touchstone
