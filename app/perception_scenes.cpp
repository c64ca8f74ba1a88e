// What the perception loop does for the scene that is shown, after the touches are out.
#include <utility>

#include "app/perception.hpp"
#include "platform/system/log.hpp"

namespace touchstone {

void Perception::serve_scene(const InteractionFrame& result, std::uint64_t timestamp_us, TableFrame& shown) {
    if (!wish_.particles) particles_.reset();
    if (wish_.particles && !particles_) particles_.emplace(device_, options_.config.particles, intrinsics_);
    if (particles_) shown.particles = move_particles(result, timestamp_us);
    if (result.state == InteractionState::live) shown.rendered = render_wish();
    scene_times_.end_frame();
}

std::shared_ptr<const ParticleView> Perception::move_particles(const InteractionFrame& result,
                                                               std::uint64_t timestamp_us) {
    const bool clears = std::exchange(particles_cleared_, wish_.particles_cleared) != wish_.particles_cleared;
    if (clears || result.state == InteractionState::scanning) particles_->clear();
    if (result.state != InteractionState::live) {
        particles_->lift_fingers();
        return nullptr;
    }
    auto view = std::make_shared<ParticleView>();
    {
        const StageTimer timer(scene_times_, "particles");
        const BackgroundModel& background = *pipeline_->background();
        const std::vector<std::uint8_t> foreground = pipeline_->foreground_map();
        std::span<const TouchEvent> touches = result.touches;
        if (calibrates(result.state)) touches = {};
        *view = particles_->advance({pipeline_->live(), background.prediction(), foreground,
                                     background.volume(), background.T_g_c(), *pipeline_->area(), touches,
                                     timestamp_us, result.hovers, wish_.tilt, &wish_.pouring_fingers});
    }
    return view;
}

std::shared_ptr<const RenderedView> Perception::render_wish() {
    if (!wish_.view) {
        scene_view_.reset();
        return nullptr;
    }
    if (!scene_view_) scene_view_.emplace(device_, intrinsics_);
    const StageTimer timer(scene_times_, "scene view");
    const BackgroundModel& background = *pipeline_->background();
    const std::vector<std::uint8_t> foreground = pipeline_->foreground_map();
    return scene_view_->see(*wish_.view, {background.volume(), background.prediction(), background.T_g_c(),
                                          *pipeline_->area(), pipeline_->live(), foreground});
}

}  // namespace touchstone
