#pragma once

#include <memory>
#include <optional>

#include "ui/particle_layer.hpp"
#include "ui/scene.hpp"

namespace touchstone {

/// Fig 9 and 13: particles run from fingertips, lie on what is there, and are pushed and held by hands. The
/// perception loop simulates them; this draws them.
class ParticlesScene : public Scene {
  public:
    std::string_view invitation() const override { return "Touch to pour; four fingers clear"; }
    void start(PixelSize view) override { layer_.emplace(view); }
    void show(const TableFrame& frame) override;
    void on_touch(const TouchEvent&) override {}
    void on_hovers(std::span<const HoverEvent>) override {}
    void update(float dt_s) override;
    const GlTexture* surface_layer() const override { return nullptr; }
    const GlTexture* overlay_layer() const override { return layer_ ? &layer_->picture() : nullptr; }
    SceneWish wish() const override {
        SceneWish wish;
        wish.particles = true;
        return wish;
    }
    void draw(Canvas&, const ViewMapping&) override {}

  private:
    std::optional<ParticleLayer> layer_;
    std::shared_ptr<const ParticleView> particles_, drawn_;
};

}  // namespace touchstone
