#include "platform/display/simulated_projector.hpp"

#include <utility>

namespace touchstone {

SimulatedProjector::SimulatedProjector(std::unique_ptr<Display> display, const std::string& name)
    : display_(std::move(display)),
      writer_(name, display_->size_px().width_px, display_->size_px().height_px) {}

void SimulatedProjector::present() {
    display_->present();
    const Picture picture = display_->read_pixels();
    writer_.show(picture.rgba, picture.width_px, picture.height_px, aim_px_);
}

}  // namespace touchstone
