#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ui/area_compositor.hpp"
#include "ui/scene_list.hpp"

namespace touchstone {

/// Several areas of the table, each with a scene of its own that knows nothing of the others.
class SplitScene : public Scene {
  public:
    /// Areas that name no scene get `table_scene`.
    SplitScene(std::string table_scene, SceneSetup setup, ScenePlace place)
        : table_scene_(std::move(table_scene)), setup_(std::move(setup)), place_(place) {}

    /// One scene for each area of the frame; those that were there with the same scene go on. Throws as
    /// make_scene.
    void set_areas(const TableFrame& frame);

    std::string_view invitation() const override { return "Touch one of the areas"; }
    void start(PixelSize view) override;
    void show(const TableFrame& frame) override;
    void on_touch(const TouchEvent& event) override;
    void on_hovers(std::span<const HoverEvent> hovers) override;
    void update(float dt_s) override;
    const GlTexture* surface_layer() const override { return surface_layer_; }
    const GlTexture* overlay_layer() const override { return overlay_layer_; }
    SceneWish wish() const override;
    std::string_view unsaved() const override;
    void draw(Canvas& canvas, const ViewMapping& view) override;

  private:
    struct Part {
        ShownArea area;
        std::unique_ptr<Scene> scene;
    };

    Part* part_of(const Fingertip& tip);
    void lift_all_fingers();
    Part make_part(const ShownArea& area, const TableFrame& frame) const;
    void show_part(Part& part, const TableFrame& frame, int index) const;

    std::string table_scene_;
    SceneSetup setup_;
    ScenePlace place_;
    int versions_before_ = 0;  ///< of pictures that parts that are gone wished for
    std::vector<Part> parts_;
    std::map<int, Fingertip> touching_;
    PixelSize view_;
    AreaCompositor surface_, overlay_;
    const GlTexture* surface_layer_ = nullptr;
    const GlTexture* overlay_layer_ = nullptr;
};

}  // namespace touchstone
