#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ui/button_row.hpp"
#include "ui/operator_view.hpp"
#include "ui/table_frame.hpp"

namespace touchstone {

enum class AreaButton { finish, undo, scene, remove, other_edge, done };

/// Named areas, made and changed by touch: the corners of a new one are touched in order around it, a touch
/// in one that is there chooses it. A corner lies where the finger leaves.
class AreaEditor {
  public:
    /// Scenes that an area may have.
    explicit AreaEditor(std::vector<std::string> scenes) : scenes_(std::move(scenes)) {}

    /// All fingers are its.
    void on_touch(const TouchEvent& event);
    /// A new frame, after its touches; what is to be changed goes into the wish. False when it is left.
    bool update(const TableFrame& frame, const OperatorView& view, OperatorWish& wish);
    /// Nobody can touch any more.
    void cancel();

    void draw(Canvas& canvas, const ViewMapping& view, const SurfaceGeometry& surface);
    /// In the depth picture, as drawn last.
    Eigen::AlignedBox2f place_px(AreaButton button) const { return row_->place_px(static_cast<int>(button)); }

  private:
    struct Corner {
        Eigen::Vector2f uv, pixel_px;
        int area;  ///< under it; -1: none
    };

    void take(const Corner& corner);
    bool press(AreaButton button);
    void finish();
    void give_next_scene();
    void remove();
    std::vector<AreaDraft> drafts() const;
    const ShownArea* chosen() const;
    std::vector<Button> buttons() const;
    std::string hint() const;
    void draw_areas(Canvas& canvas, const ViewMapping& view) const;
    void draw_new_one(Canvas& canvas, const ViewMapping& view) const;
    void draw_hint(Canvas& canvas, const ViewMapping& view) const;

    std::vector<std::string> scenes_;
    std::vector<ShownArea> areas_;
    std::vector<Corner> corners_;                    ///< of a new one
    std::string chosen_;                             ///< name; empty: none
    std::map<int, Corner> fingers_;                  ///< where they are, of those not on the row
    std::optional<std::vector<AreaDraft>> changed_;  ///< to be sent
    std::string told_, refusal_;  ///< what the perception loop said last, and as far as it is still shown
    bool is_waiting_ = false;     ///< for what becomes of the last change
    float mm_per_px_ = 1.f;
    RowEdge edge_ = RowEdge::bottom;
    std::unique_ptr<ButtonRow> row_ = std::make_unique<ButtonRow>(edge_);
};

}  // namespace touchstone
