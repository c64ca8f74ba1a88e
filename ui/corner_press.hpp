#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>

#include "pipeline/touch_event.hpp"
#include "ui/surface_geometry.hpp"

namespace touchstone {

inline constexpr std::uint64_t corner_press_us = 2'000'000;
/// On the surface: how far from a corner of the area a finger may be, and how far it may stray.
inline constexpr float corner_reach_mm = 60.f, corner_stray_mm = 15.f;

/// Notices a finger that rests in a corner of the interactive area, which nobody does by chance.
class CornerPress {
  public:
    /// The finger goes on to be whose it was.
    void on_touch(const TouchEvent& event);
    /// Moves time on, the frames'; true once a finger has rested long enough.
    bool update(const TableFrame& frame, const SurfaceGeometry& surface);
    void cancel() { fingers_.clear(); }

  private:
    struct Finger {
        Eigen::Vector2f down_px;
        std::uint64_t since_us;
    };
    bool is_in_corner(const Eigen::Vector2f& place_px) const;

    std::map<int, Finger> fingers_;
    std::array<Eigen::Vector2f, 4> corners_px_{};
    bool has_area_ = false;
    float mm_per_px_ = 1.f;
    std::uint64_t now_us_ = 0;
};

}  // namespace touchstone
