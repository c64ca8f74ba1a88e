#include "ui/calibration_screen.hpp"

#include <algorithm>

#include "ui/cross_guide.hpp"

namespace touchstone {
namespace {

constexpr float design_height_px = 720.f;  // of style.hpp
constexpr float words_share = 0.6f;        // of the width

/// Runs of one colour in a row are drawn at once, and rows alike with them: stripes are few rectangles.
void fill(GLint x_px, GLint y_px, GLsizei width_px, GLsizei height_px, std::uint8_t gray) {
    const float value = static_cast<float>(gray) / 255.f;
    glScissor(x_px, y_px, width_px, height_px);
    glClearColor(value, value, value, 1.f);
    glClear(GL_COLOR_BUFFER_BIT);
}

}  // namespace

void CalibrationScreen::draw(const ThrownPicture& picture) {
    display_.begin_frame();
    const PixelSize size = display_.size_px();
    glClearColor(0.f, 0.f, 0.f, 1.f);
    glClear(GL_COLOR_BUFFER_BIT);
    const Eigen::Vector2f size_px(static_cast<float>(size.width_px), static_cast<float>(size.height_px));
    canvas_.begin(size_px, size_px.y() / design_height_px);
    if (picture.gray.size() ==
        static_cast<std::size_t>(size.width_px) * static_cast<std::size_t>(size.height_px))
        draw_pattern(picture.gray);
    if (picture.cross_px) draw_cross(*picture.cross_px);
    // Words keep away from the cross.
    const float aside = !picture.cross_px ? 0.f : picture.cross_px->y() < 0.5f * size_px.y() ? 0.25f : -0.25f;
    draw_words(0.5f * size_px + Eigen::Vector2f(0.f, aside * size_px.y()), picture.words);
    renderer_.draw(canvas_);
}

void CalibrationScreen::draw_pattern(std::span<const std::uint8_t> gray) {
    const PixelSize size = display_.size_px();
    const auto width = static_cast<std::size_t>(size.width_px);
    const auto row_of = [&](int y) { return gray.subspan(static_cast<std::size_t>(y) * width, width); };
    glEnable(GL_SCISSOR_TEST);
    for (int top = 0, end = 0; top < size.height_px; top = end) {
        const auto row = row_of(top);
        for (end = top + 1; end < size.height_px; ++end)
            if (!std::ranges::equal(row, row_of(end))) break;
        for (std::size_t left = 0, right = 0; left < width; left = right) {
            for (right = left + 1; right < width && row[right] == row[left];) ++right;
            fill(static_cast<GLint>(left), size.height_px - end, static_cast<GLsizei>(right - left),
                 end - top, row[left]);
        }
    }
    glDisable(GL_SCISSOR_TEST);
}

/// Pixel centres lie at whole numbers in the projector's model, at halves on the display.
void CalibrationScreen::draw_cross(const Eigen::Vector2f& cross_px) {
    touchstone::draw_cross(canvas_, cross_px + Eigen::Vector2f(0.5f, 0.5f));
}

void CalibrationScreen::draw_words(const Eigen::Vector2f& middle_px, const std::string& words) {
    const float wrap_px = words_share * canvas_.size_px().x();
    const Eigen::Vector2f size = canvas_.text_size_px(TextStyle::heading, words, wrap_px);
    canvas_.text(TextStyle::heading, middle_px - 0.5f * size, style::text, words, wrap_px);
}

}  // namespace touchstone
