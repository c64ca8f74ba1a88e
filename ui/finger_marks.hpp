#pragma once

#include <map>
#include <span>
#include <vector>

#include "pipeline/touch_event.hpp"
#include "ui/canvas.hpp"
#include "ui/view_mapping.hpp"

namespace touchstone {

/// Knows which fingers touch and hover now, and shows them: touches as discs, hovers as rings that close in
/// as the finger comes down.
class FingerMarks {
  public:
    void on_touch(const TouchEvent& event);
    void on_hovers(std::span<const HoverEvent> hovers);
    void clear();

    const std::map<int, Fingertip>& touching() const { return touching_; }
    std::vector<int> touching_ids() const;
    void draw(Canvas& canvas, const ViewMapping& view) const;

  private:
    std::map<int, Fingertip> touching_;
    std::vector<HoverEvent> hovering_;
};

}  // namespace touchstone
