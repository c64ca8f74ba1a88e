#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <string_view>

#include "ui/fonts.hpp"
#include "ui/style.hpp"

struct ImDrawList;

namespace touchstone {

/// The 2D drawing of one frame: shapes and text, collected here, drawn by CanvasRenderer. Coordinates are
/// display pixels, y down.
class Canvas {
  public:
    explicit Canvas(FontFiles files = default_font_files());
    ~Canvas();

    /// Forgets the last frame. The letters are drawn again when the scale has changed.
    void begin(const Eigen::Vector2f& size_px, float scale);

    float scale() const { return scale_; }
    Eigen::Vector2f size_px() const { return size_px_; }
    ImDrawList& list() { return *list_; }
    Fonts& fonts() { return *fonts_; }
    /// Grows each time the letters were drawn again.
    int fonts_version() const { return fonts_version_; }

    /// `at_px` is the upper left corner. Breaks lines at `wrap_px` unless that is 0.
    void text(TextStyle style, const Eigen::Vector2f& at_px, style::Color color, std::string_view words,
              float wrap_px = 0.f);
    Eigen::Vector2f text_size_px(TextStyle style, std::string_view words, float wrap_px = 0.f) const;
    void disc(const Eigen::Vector2f& center_px, float radius_px, style::Color color);
    void ring(const Eigen::Vector2f& center_px, float radius_px, float width_px, style::Color color);
    /// Part of a ring from the top, clockwise: 0..1 of a turn.
    void arc(const Eigen::Vector2f& center_px, float radius_px, float width_px, float from_turn,
             float to_turn, style::Color color);
    void line(const Eigen::Vector2f& a_px, const Eigen::Vector2f& b_px, float width_px, style::Color color);
    void box(const Eigen::Vector2f& min_px, const Eigen::Vector2f& max_px, float corner_px,
             style::Color color);
    /// Until end_clip nothing is drawn outside that box.
    void begin_clip(const Eigen::Vector2f& min_px, const Eigen::Vector2f& max_px);
    void end_clip();

  private:
    struct SharedData;

    FontFiles files_;
    float scale_ = 0.f;
    Eigen::Vector2f size_px_{0.f, 0.f};
    int fonts_version_ = 0;
    std::unique_ptr<Fonts> fonts_;
    std::unique_ptr<SharedData> shared_;
    std::unique_ptr<ImDrawList> list_;
};

}  // namespace touchstone
