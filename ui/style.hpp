#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

/// The look of everything we draw, in one place. Lengths are pixels of a display 720 pixels high;
/// Canvas::scale() takes them to the real one. Type is set to be read from a metre.
namespace touchstone::style {

struct Color {
    std::uint8_t r = 0, g = 0, b = 0, a = 255;

    constexpr Color faded(float opacity) const {
        return {r, g, b, static_cast<std::uint8_t>(static_cast<float>(a) * opacity)};
    }
    /// Bytes r, g, b, a in memory, as draw lists and vertex buffers want it.
    constexpr std::uint32_t packed() const {
        return static_cast<std::uint32_t>(r) | static_cast<std::uint32_t>(g) << 8 |
               static_cast<std::uint32_t>(b) << 16 | static_cast<std::uint32_t>(a) << 24;
    }
    constexpr bool operator==(const Color&) const = default;
};

inline constexpr Color backdrop{14, 17, 22};
inline constexpr Color no_light{0, 0, 0};  ///< around what is projected
inline constexpr Color card{20, 24, 31, 235};
inline constexpr Color rule{255, 255, 255, 26};
inline constexpr Color text{236, 240, 245};
inline constexpr Color text_muted{142, 152, 167};
inline constexpr Color accent{86, 194, 255};
inline constexpr Color good{61, 220, 151};
inline constexpr Color warning{255, 184, 77};
inline constexpr Color bad{255, 107, 107};
inline constexpr Color white{255, 255, 255};
inline constexpr Color shadow{8, 10, 14};

/// One colour a finger; far apart in hue from its neighbours, and clear of the grey of a shaded surface.
inline constexpr std::array<Color, 8> palette{{{255, 92, 92},
                                               {41, 182, 246},
                                               {255, 179, 36},
                                               {46, 204, 128},
                                               {171, 113, 255},
                                               {255, 112, 190},
                                               {22, 200, 187},
                                               {166, 214, 58}}};

constexpr Color finger_color(int id) {
    return palette[static_cast<std::size_t>(static_cast<unsigned>(id)) % palette.size()];
}

inline constexpr float caption_px = 18.f;
inline constexpr float body_px = 21.f;
inline constexpr float heading_px = 29.f;
inline constexpr float title_px = 29.f;
inline constexpr float figure_px = 52.f;

inline constexpr float margin_px = 28.f;
inline constexpr float panel_min_px = 250.f;
inline constexpr float panel_max_px = 330.f;
inline constexpr float bar_px = 64.f;
inline constexpr float corner_px = 14.f;
inline constexpr float touch_radius_px = 11.f;
inline constexpr float hover_radius_px = 13.f;
inline constexpr float ring_px = 3.f;

/// On the surface. The second is about a fingertip.
inline constexpr std::array<float, 3> stroke_widths_mm{6.f, 14.7f, 34.f};
inline constexpr float eraser_growth = 2.2f;  ///< of the stroke's width

}  // namespace touchstone::style
