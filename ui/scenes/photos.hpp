#pragma once

#include <optional>
#include <string>

#include "ui/gestures.hpp"
#include "ui/photo_layer.hpp"
#include "ui/photo_table.hpp"
#include "ui/scene.hpp"
#include "ui/scene_setup.hpp"
#include "ui/surface_geometry.hpp"

namespace touchstone {

/// Pictures of a folder lie on the table: one finger drags and throws, two turn and stretch, a double tap
/// straightens and enlarges. Several people at once, each at a picture of their own.
class PhotosScene : public Scene {
  public:
    explicit PhotosScene(const SceneSetup& setup);

    std::string_view invitation() const override { return "Drag, turn and stretch the pictures"; }
    void start(PixelSize view) override;
    void show(const TableFrame& frame) override;
    void on_touch(const TouchEvent& event) override;
    void on_hovers(std::span<const HoverEvent>) override {}
    void update(float dt_s) override;
    const GlTexture* surface_layer() const override { return layer_.picture(); }
    void draw(Canvas& canvas, const ViewMapping& view) override;

    const PhotoTable& table() const { return table_; }

  private:
    void open();
    void take_next_picture();
    void add(const Picture& picture, int of);
    float mm_per_px() const { return surface_.mm_per_px(surface_.room().box_px().center()); }

    SceneSetup setup_;
    PixelSize view_;
    SurfaceGeometry surface_;
    PhotoTable table_;
    std::optional<GestureRecognizer> gestures_;
    PhotoLayer layer_;
    PictureStream stream_;
    bool is_open_ = false, shows_samples_ = false, is_dirty_ = false;
    std::uint64_t now_us_ = 0;
};

}  // namespace touchstone
