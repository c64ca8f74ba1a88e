#include "ui/scenes/particles.hpp"

#include "ui/table_frame.hpp"

namespace touchstone {

void ParticlesScene::show(const TableFrame& frame) { particles_ = frame.particles; }

void ParticlesScene::update(float) {
    if (!layer_ || particles_ == drawn_) return;
    layer_->draw(particles_.get());
    drawn_ = particles_;
}

}  // namespace touchstone
