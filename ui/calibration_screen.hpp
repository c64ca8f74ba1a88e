#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>

#include "platform/display/display.hpp"
#include "ui/canvas.hpp"
#include "ui/canvas_renderer.hpp"

namespace touchstone {

/// What a projector throws while it is calibrated, in its own pixels. Lives on the display's thread.
class CalibrationScreen {
  public:
    /// Throws Error{unavailable} when fonts or shaders fail.
    explicit CalibrationScreen(Display& display) : display_(display) {}

    /// Grey, one byte for each of the display's pixels, row 0 at the top; shown pixel by pixel.
    void show_pattern(std::span<const std::uint8_t> gray);
    /// A cross on black to be touched, and what to do in words.
    void show_cross(const Eigen::Vector2f& cross_px, const std::string& words);
    /// Words on black.
    void show_words(const std::string& words);

  private:
    void begin(float gray);
    void draw_words(const Eigen::Vector2f& middle_px, const std::string& words);

    Display& display_;
    Canvas canvas_;
    CanvasRenderer renderer_;
};

}  // namespace touchstone
