#pragma once

#include <optional>

#include "ui/button_row.hpp"
#include "ui/gestures.hpp"
#include "ui/orbit.hpp"
#include "ui/rendered_picture.hpp"
#include "ui/scene.hpp"
#include "ui/surface_geometry.hpp"

namespace touchstone {

/// The scan as a thing one turns: one finger turns it, two move, stretch and roll it, three move it, a double
/// tap brings it back. Shown shaded, as normals, in its colours, or with the hands that are over it.
class InspectScene : public Scene {
  public:
    InspectScene();

    std::string_view invitation() const override { return "Turn the scan with one finger, zoom with two"; }
    void start(PixelSize view) override;
    void show(const TableFrame& frame) override;
    void on_touch(const TouchEvent& event) override;
    void on_hovers(std::span<const HoverEvent>) override {}
    void update(float dt_s) override;
    const GlTexture* surface_layer() const override { return nullptr; }
    const GlTexture* overlay_layer() const override { return picture_.texture(); }
    bool hides_table() const override { return true; }
    SceneWish wish() const override;
    void draw(Canvas& canvas, const ViewMapping& view) override;

  private:
    void set_buttons();
    void follow(const Gesture& gesture);

    PixelSize view_;
    SurfaceGeometry surface_;
    ButtonRow styles_{RowEdge::bottom};
    std::optional<GestureRecognizer> gestures_;
    std::optional<Orbit> orbit_;  // from the first frame with an area on
    ViewStyle style_ = ViewStyle::shaded;
    bool has_colors_ = false;
    RenderedPicture picture_;
    std::uint64_t now_us_ = 0;
};

}  // namespace touchstone
