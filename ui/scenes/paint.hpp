#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "ui/button_row.hpp"
#include "ui/painting.hpp"
#include "ui/scene.hpp"
#include "ui/scene_setup.hpp"
#include "ui/stroke_layer.hpp"
#include "ui/surface_geometry.hpp"

namespace touchstone {

/// Fig 10: fingers draw coloured strokes on the surface. They are kept where they lie in the scan, so that
/// they stay there when the camera finds itself elsewhere, and in a file when there is one.
class PaintScene : public Scene {
  public:
    explicit PaintScene(const SceneSetup& setup);
    /// Saves what is not saved yet.
    ~PaintScene() override;

    std::string_view invitation() const override { return "Touch the surface to paint"; }
    void start(PixelSize view) override;
    void show(const TableFrame& frame) override;
    void on_touch(const TouchEvent& event) override;
    void on_hovers(std::span<const HoverEvent>) override {}
    void update(float dt_s) override;
    const GlTexture* surface_layer() const override;
    void draw(Canvas& canvas, const ViewMapping& view) override;
    std::string_view unsaved() const override { return unsaved_; }

    const ButtonRow& tools() const { return tools_; }

  private:
    /// A stroke that goes on.
    struct Finger {
        int stroke;
        StrokePath path;
    };

    void begin_stroke(const Fingertip& tip);
    void press(int tool);
    void set_tools();
    void redraw();
    void draw_pieces(const Stroke& stroke, const Eigen::Vector3f& at_g_m);
    void load(const RigidTransform& T_g_c);
    void save_when_quiet();
    void save();

    std::string file_;
    PixelSize view_;
    SurfaceGeometry surface_;
    RigidTransform drawn_T_g_c_ = RigidTransform::Identity();
    std::optional<StrokeLayer> layer_;
    Painting painting_;
    int redraws_done_ = 0;
    std::map<int, Finger> fingers_;
    std::vector<StrokePiece> pieces_;
    ButtonRow tools_{RowEdge::bottom};
    std::optional<style::Color> color_;  // none: one for each finger
    bool erases_ = false;
    std::size_t width_ = 1;
    bool is_loaded_ = false, saw_scan_ = false, is_saved_ = true;
    std::string unsaved_;  // why the last save failed
    std::uint64_t now_us_ = 0, changed_us_ = 0, next_save_us_ = 0;
};

/// Ids of the buttons of PaintScene::tools(); colours follow `first_color` in the order of the palette.
namespace paint_tool {
inline constexpr int each_finger = 0, first_color = 1, white = 20, eraser = 21, first_width = 30, undo = 40,
                     clear = 41;
}  // namespace paint_tool

}  // namespace touchstone
