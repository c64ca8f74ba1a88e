#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "pipeline/touch_event.hpp"
#include "ui/canvas.hpp"
#include "ui/icons.hpp"
#include "ui/surface_geometry.hpp"
#include "ui/view_mapping.hpp"

namespace touchstone {

struct Button {
    int id = 0;
    Icon icon = Icon::scene;
    style::Color color = style::text;  ///< of the icon
    float fill = 1.f;                  ///< of the icon, see draw_icon
    std::string label;                 ///< under the icon; may be empty
    bool selected = false;
    bool enabled = true;
    bool is_held = false;     ///< pressed by a touch of button_hold_us, which a ring shows; else at once
    bool gap_before = false;  ///< begins a group
};

enum class RowEdge { top, bottom };

inline constexpr std::uint64_t button_hold_us = 800'000;
/// On the surface: what buttons have where there is room, and what they never fall short of.
inline constexpr float button_mm = 44.f, least_button_mm = 16.f;

/// Buttons in a row along an edge of the interactive area, to be touched. They are told as pressed when a
/// finger comes down: a place that jitters or a finger that is lost cannot make it fail.
class ButtonRow {
  public:
    explicit ButtonRow(RowEdge edge) : edge_(edge) {}

    /// Replaces all; fingers on buttons that stay go on.
    void set(std::vector<Button> buttons) { buttons_ = std::move(buttons); }
    const std::vector<Button>& buttons() const { return buttons_; }
    /// Puts each in its place on the surface for the touches to come. With a label, all are as wide as the
    /// widest.
    void lay_out(const Canvas& canvas, const ViewMapping& view, const SurfaceGeometry& surface);
    /// True when the finger came down on the row, or did and is still told of: it is nobody else's.
    bool on_touch(const TouchEvent& event);
    /// Moves time on, the frames', and tells the ids pressed since the last call.
    std::vector<int> update(std::uint64_t now_us);
    /// Forgets all fingers.
    void cancel() { fingers_.clear(); }
    bool is_touched() const { return !fingers_.empty(); }
    void draw(Canvas& canvas, const ViewMapping& view) const;

    /// Of a button, in the depth picture; empty when there is none or before the first lay_out.
    Eigen::AlignedBox2f place_px(int id) const;
    /// Of all, with the card behind them.
    Eigen::AlignedBox2f card_px() const { return card_px_; }

  private:
    struct Finger {
        int button;  // -1: beside them
        std::uint64_t since_us;
        bool told;
    };
    const Button* find(int id) const;
    void draw_button(Canvas& canvas, const ViewMapping& view, const Button& button,
                     const Eigen::AlignedBox2f& place) const;
    float held_share(int id) const;

    RowEdge edge_;
    std::vector<Button> buttons_;
    std::vector<Eigen::AlignedBox2f> places_px_;  // of buttons_
    Eigen::AlignedBox2f card_px_;
    bool shows_labels_ = false;
    float label_height_px_ = 0.f;  // of the highest, on the display
    std::map<int, Finger> fingers_;
    std::map<int, std::uint64_t> left_us_;  // by button: when a finger left it
    std::vector<int> pressed_;
    std::uint64_t now_us_ = 0;
};

}  // namespace touchstone
