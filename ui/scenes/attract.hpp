#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ui/scene.hpp"
#include "ui/surface_geometry.hpp"

namespace touchstone {

/// What runs until someone comes: rings spread over the surface as on water, and words ask to touch it. All
/// is somewhere else each time, so that a projector or a screen burns nothing in over months.
class AttractScene : public Scene {
  public:
    std::string_view invitation() const override { return "Touch the surface"; }
    void start(PixelSize view) override { view_ = view; }
    void show(const TableFrame& frame) override;
    /// A touch makes a ring of its own.
    void on_touch(const TouchEvent& event) override;
    void on_hovers(std::span<const HoverEvent>) override {}
    void update(float dt_s) override;
    const GlTexture* surface_layer() const override { return nullptr; }
    void draw(Canvas& canvas, const ViewMapping& view) override { draw(canvas, view, 1.f); }
    /// Over what another scene has left.
    void draw(Canvas& canvas, const ViewMapping& view, float opacity) const;

  private:
    struct Ring {
        Eigen::Vector2f center_px;
        float age_s;
        style::Color color;
    };
    Eigen::Vector2f place_px(std::uint64_t number, float margin_mm) const;
    void add_ring(const Eigen::Vector2f& center_px, style::Color color);
    void draw_ring(Canvas& canvas, const ViewMapping& view, const Ring& ring, float opacity) const;
    void draw_words(Canvas& canvas, const ViewMapping& view, float opacity) const;

    PixelSize view_;
    SurfaceGeometry surface_;
    std::vector<Ring> rings_;
    std::uint64_t rings_made_ = 0, words_made_ = 0;
    float to_next_ring_s_ = 0.f, words_age_s_ = 0.f;
};

}  // namespace touchstone
