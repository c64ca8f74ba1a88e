#include "ui/scenes/paint.hpp"

namespace touchstone {

void PaintScene::start(PixelSize view) {
    strokes_.clear();
    if (layer_ && view == view_)
        layer_->clear();
    else
        layer_.emplace(view);
    view_ = view;
}

void PaintScene::on_touch(const TouchEvent& event) {
    if (!layer_) return;
    const auto& [tip, phase] = event;
    pieces_.clear();
    const auto stroke = strokes_.find(tip.id);
    // A touch whose beginning was never told starts where it is first seen.
    if (stroke == strokes_.end() || phase == TouchPhase::down)
        strokes_.insert_or_assign(tip.id, StrokePath(tip.pixel_px, pieces_));
    else if (phase == TouchPhase::move)
        stroke->second.move(tip.pixel_px, pieces_);
    else
        stroke->second.finish(tip.pixel_px, pieces_);
    if (phase == TouchPhase::up) strokes_.erase(tip.id);
    layer_->add(pieces_, style::finger_color(tip.id));
}

void PaintScene::update(float) {
    if (layer_) layer_->flush();
}

const GlTexture* PaintScene::surface_layer() const { return layer_ ? &layer_->picture() : nullptr; }

}  // namespace touchstone
