#pragma once

#include <memory>
#include <set>

#include "ui/button_row.hpp"
#include "ui/corner_press.hpp"
#include "ui/operator_view.hpp"
#include "ui/picture_tile.hpp"

namespace touchstone {

enum class OperatorButton { rescan, recalibrate, calibrate_projector, record, close };

/// What whoever looks after the table wants to know and to do, over everything. It is opened by a finger that
/// rests in a corner of the area, or by a key, and closed by its button or after a minute. Lives and dies
/// while its context is current.
class OperatorPanel {
  public:
    OperatorPanel();

    /// True when the finger is the panel's: while it is open, all are.
    bool on_touch(const TouchEvent& event);
    /// A new frame, after its touches; true when it has just opened by touch.
    bool update(const TableFrame& frame, const SurfaceGeometry& surface);
    /// By a key.
    void toggle();
    bool is_open() const { return wish_.open; }
    const OperatorWish& wish() const { return wish_; }
    /// Nobody can touch any more.
    void cancel();

    /// Lays itself out for the touches to come, and draws; the pictures on it come afterwards.
    void draw(Canvas& canvas, const ViewMapping& view, const SurfaceGeometry& surface,
              const TableFrame& frame);
    void draw_pictures(PixelSize display) const;
    /// In the depth picture, as drawn last.
    Eigen::AlignedBox2f place_px(OperatorButton button) const;

  private:
    void open(std::uint64_t now_us);
    void press(OperatorButton button);
    std::vector<Button> buttons() const;

    OperatorWish wish_;
    CornerPress corner_press_;
    ButtonRow row_{RowEdge::bottom};
    std::set<int> fingers_;  ///< that came down while it was open
    std::shared_ptr<const OperatorView> view_;
    PictureTile depth_, mask_;
    DisplayRect depth_box_, mask_box_;
    std::uint64_t now_us_ = 0, touched_us_ = 0;
};

}  // namespace touchstone
