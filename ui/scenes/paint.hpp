#pragma once

#include <map>
#include <optional>
#include <vector>

#include "ui/scene.hpp"
#include "ui/stroke_layer.hpp"

namespace touchstone {

/// Fig 10: fingers draw coloured strokes on the surface.
class PaintScene : public Scene {
  public:
    std::string_view invitation() const override { return "Touch the surface to paint"; }
    void start(PixelSize view) override;
    void on_touch(const TouchEvent& event) override;
    void on_hovers(std::span<const HoverEvent>) override {}
    void update(float dt_s) override;
    const GlTexture* surface_layer() const override;
    void draw(Canvas&, const ViewMapping&) override {}

  private:
    PixelSize view_;
    std::optional<StrokeLayer> layer_;
    std::map<int, StrokePath> strokes_;  // one for each finger in contact
    std::vector<StrokePiece> pieces_;
};

}  // namespace touchstone
