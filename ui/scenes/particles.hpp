#pragma once

#include <memory>
#include <optional>

#include "pipeline/particle_view.hpp"
#include "ui/button_row.hpp"
#include "ui/particle_layer.hpp"
#include "ui/scene.hpp"
#include "ui/surface_geometry.hpp"
#include "ui/tilt_pad.hpp"

namespace touchstone {

/// Fig 7, 9, 13: balls pour from fingers that touch, roll over what lies there, are pushed, scooped and held
/// by hands. The perception loop simulates them; this draws them, and asks it to clear or tilt the table.
class ParticlesScene : public Scene {
  public:
    /// The share of gravity that a knob at the pad's edge turns along the table.
    static constexpr float most_tilt = 0.6f;

    ParticlesScene();

    std::string_view invitation() const override { return "Touch to pour; four fingers clear"; }
    void start(PixelSize view) override;
    void show(const TableFrame& frame) override;
    void on_touch(const TouchEvent& event) override;
    void on_hovers(std::span<const HoverEvent>) override {}
    void update(float dt_s) override;
    const GlTexture* surface_layer() const override { return layer_ ? &layer_->shadows() : nullptr; }
    const GlTexture* overlay_layer() const override { return layer_ ? &layer_->picture() : nullptr; }
    SceneWish wish() const override;
    void draw(Canvas& canvas, const ViewMapping& view) override;

  private:
    PixelSize view_;
    SurfaceGeometry surface_;
    std::optional<ParticleLayer> layer_;
    std::shared_ptr<const ParticleView> particles_, drawn_;
    ButtonRow tools_{RowEdge::bottom};
    TiltPad pad_;
    std::vector<int> pouring_;  // fingers
    int cleared_ = 0;
    std::uint64_t now_us_ = 0;
};

}  // namespace touchstone
