#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>

#include "platform/display/display.hpp"
#include "ui/canvas.hpp"
#include "ui/canvas_renderer.hpp"
#include "ui/thrown_picture.hpp"

namespace touchstone {

/// What a projector throws while it is calibrated, in its own pixels. Lives on the display's thread.
class CalibrationScreen {
  public:
    /// Throws Error{unavailable} when fonts or shaders fail.
    explicit CalibrationScreen(Display& display) : display_(display) {}

    /// Grey pictures pixel by pixel; of another size than the display's they are not drawn. To be presented.
    void draw(const ThrownPicture& picture);

  private:
    void draw_pattern(std::span<const std::uint8_t> gray);
    void draw_cross(const Eigen::Vector2f& cross_px);
    void draw_words(const Eigen::Vector2f& middle_px, const std::string& words);

    Display& display_;
    Canvas canvas_;
    CanvasRenderer renderer_;
};

}  // namespace touchstone
