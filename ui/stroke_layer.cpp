#include "ui/stroke_layer.hpp"

#include "ui/shader.hpp"

namespace touchstone {

namespace {

constexpr int layer_px_per_view_px = 2;

float to_layer(float view_px) { return (view_px + 0.5f) * layer_px_per_view_px; }

}  // namespace

StrokeLayer::StrokeLayer(PixelSize view)
    : program_(make_program("stroke")),
      picture_({view.width_px * layer_px_per_view_px, view.height_px * layer_px_per_view_px}) {
    const auto width = static_cast<float>(picture_.size_px().width_px);
    program_.use();
    glUniform2f(program_.uniform("u_layer_size_px"), width, static_cast<float>(picture_.size_px().height_px));
    glUniform1f(program_.uniform("u_radius_px"), 0.5f * style::stroke_width_of_view * width);
    clear();
}

void StrokeLayer::clear() {
    waiting_.clear();
    picture_.bind();
    glClearColor(0.f, 0.f, 0.f, 0.f);
    glClear(GL_COLOR_BUFFER_BIT);
}

void StrokeLayer::add(std::span<const StrokePiece> pieces, style::Color color) {
    for (const StrokePiece& piece : pieces)
        waiting_.push_back({{to_layer(piece.a_px.x()), to_layer(piece.a_px.y()), to_layer(piece.b_px.x()),
                             to_layer(piece.b_px.y())},
                            color.packed()});
}

void StrokeLayer::flush() {
    if (waiting_.empty()) return;
    picture_.bind();
    program_.use();
    quads_.draw(waiting_);
    waiting_.clear();
}

}  // namespace touchstone
