#pragma once

#include <GLES3/gl31.h>
#include <SDL.h>
#include <span>

#include "platform/display/display.hpp"

namespace touchstone::test {

/// Four fields of different colours, so that a picture upside down or shifted is none of it.
inline void show_four_fields(Display& display) {
    display.begin_frame();
    const auto [width, height] = display.size_px();
    glEnable(GL_SCISSOR_TEST);
    for (int field = 0; field < 4; ++field) {
        const bool right = field % 2 == 1, top = field / 2 == 1;
        glScissor(right ? width / 3 : 0, top ? height / 4 : 0, width, height);
        glClearColor(right ? 1.f : 0.2f, top ? 0.6f : 0.f, 0.4f, 1.f);
        glClear(GL_COLOR_BUFFER_BIT);
    }
    glDisable(GL_SCISSOR_TEST);
    display.present();
}

/// As SDL tells of it.
inline void press(SDL_Keycode key) {
    SDL_Event event{};
    event.type = SDL_KEYDOWN;
    event.key.keysym.sym = key;
    SDL_PushEvent(&event);
}

/// Of a picture and one of as many pixels with 3 or 4 channels.
inline bool same_colors(const Picture& a, std::span<const std::uint8_t> b, int b_channels) {
    const auto step = static_cast<std::size_t>(b_channels);
    for (std::size_t pixel = 0; pixel < a.rgba.size() / 4; ++pixel)
        for (std::size_t channel = 0; channel < 3; ++channel)
            if (a.rgba[4 * pixel + channel] != b[step * pixel + channel]) return false;
    return true;
}

}  // namespace touchstone::test
