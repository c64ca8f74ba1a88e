#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ui/button_row.hpp"

namespace touchstone {

/// Changes scenes by touch: a handle at the upper edge of the interactive area opens a row of all scenes. It
/// closes after a choice, a touch elsewhere, or some seconds.
class TouchMenu {
  public:
    explicit TouchMenu(std::vector<std::string> scenes);

    /// True when the finger is the menu's. While it is open, all are: the one that closes it draws nothing.
    bool on_touch(const TouchEvent& event);
    /// Moves time on, the frames'; the scene chosen since the last call.
    std::optional<std::string> update(std::uint64_t now_us);
    /// When nobody can touch any more, or another picture covers it.
    void close();
    bool is_open() const { return open_; }
    /// Lays itself out for the touches to come, and draws.
    void draw(Canvas& canvas, const ViewMapping& view, const SurfaceGeometry& surface,
              const std::string& shown_scene);

    /// In the depth picture, as drawn last.
    Eigen::AlignedBox2f handle_px() const { return handle_.card_px(); }
    Eigen::AlignedBox2f place_px(const std::string& scene) const;

  private:
    std::vector<std::string> scenes_;
    ButtonRow handle_{RowEdge::top}, row_{RowEdge::top};
    std::vector<int> closing_fingers_;
    bool open_ = false;
    std::uint64_t now_us_ = 0, touched_us_ = 0;
};

}  // namespace touchstone
