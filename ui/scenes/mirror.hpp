#pragma once

#include <array>
#include <map>
#include <optional>

#include "ui/button_row.hpp"
#include "ui/gestures.hpp"
#include "ui/mesh_rasteriser.hpp"
#include "ui/rendered_picture.hpp"
#include "ui/scene.hpp"
#include "ui/scene_setup.hpp"
#include "ui/surface_geometry.hpp"
#include "ui/table_things.hpp"

namespace touchstone {

/// Fig 6 and 12: a ball that mirrors the room and a model stand on the table among the real things, hide them
/// and are hidden by them. One finger drags, two stretch and turn.
class MirrorScene : public Scene {
  public:
    explicit MirrorScene(const SceneSetup& setup);

    std::string_view invitation() const override {
        return "Drag the ball and the model, stretch and turn them";
    }
    void start(PixelSize view) override;
    void show(const TableFrame& frame) override;
    void on_touch(const TouchEvent& event) override;
    void on_hovers(std::span<const HoverEvent>) override {}
    void update(float dt_s) override;
    const GlTexture* surface_layer() const override { return nullptr; }
    const GlTexture* overlay_layer() const override { return picture_.texture(); }
    SceneWish wish() const override;
    void draw(Canvas& canvas, const ViewMapping& view) override;

  private:
    void open(const TableFrame& frame);
    void changed();

    std::shared_ptr<const MeshModel> model_;
    PixelSize view_;
    SurfaceGeometry surface_;
    ButtonRow tools_{RowEdge::bottom};
    std::optional<TableThings> things_;  // from the first frame with an area on
    std::optional<GestureRecognizer> gestures_;
    std::optional<MeshRasteriser> rasteriser_, from_light_;
    std::shared_ptr<const MeshPicture> mesh_, mesh_from_light_;
    RenderedPicture picture_;
    RigidTransform T_g_c_ = RigidTransform::Identity();
    bool mesh_is_old_ = true;
    bool over_camera_ = false;  // the camera's own picture is shown
    std::uint64_t now_us_ = 0;
};

}  // namespace touchstone
