#include "ui/scenes/particles.hpp"

#include "ui/table_frame.hpp"

namespace touchstone {

ParticlesScene::ParticlesScene() {
    Button clears;
    clears.icon = Icon::clear;
    tools_.set({clears});
}

void ParticlesScene::start(PixelSize view) {
    view_ = view;
    layer_.emplace(view);
    drawn_ = nullptr;
    pouring_.clear();
}

void ParticlesScene::show(const TableFrame& frame) {
    now_us_ = frame.timestamp_us;
    particles_ = frame.particles;
    surface_ = SurfaceGeometry(frame, view_);
}

void ParticlesScene::on_touch(const TouchEvent& event) {
    std::erase(pouring_, event.tip.id);
    if (tools_.on_touch(event) || pad_.on_touch(event)) return;
    if (event.phase != TouchPhase::up) pouring_.push_back(event.tip.id);
}

void ParticlesScene::update(float dt_s) {
    cleared_ += static_cast<int>(tools_.update(now_us_).size());
    pad_.update(dt_s);
    if (!layer_ || particles_ == drawn_) return;
    layer_->draw(particles_.get());
    drawn_ = particles_;
}

SceneWish ParticlesScene::wish() const {
    SceneWish wish;
    wish.particles = true;
    wish.particles_cleared = cleared_;
    wish.pouring_fingers = pouring_;
    wish.tilt = most_tilt * surface_.along_area(pad_.offset());
    return wish;
}

void ParticlesScene::draw(Canvas& canvas, const ViewMapping& view) {
    tools_.lay_out(canvas, view, surface_);
    tools_.draw(canvas, view);
    pad_.lay_out(surface_);
    pad_.draw(canvas, view);
}

}  // namespace touchstone
