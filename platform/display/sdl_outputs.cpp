#include "platform/display/sdl_outputs.hpp"

#include <algorithm>
#include <cstdlib>

#include "platform/display/connectors.hpp"
#include "platform/display/sdl_surface.hpp"

namespace touchstone {

namespace {

ScreenMode to_mode(const SDL_DisplayMode& mode) { return {{mode.w, mode.h}, mode.refresh_rate}; }

std::vector<ScreenMode> modes_of(int display) {
    std::vector<ScreenMode> modes;
    for (int i = 0; i < SDL_GetNumDisplayModes(display); ++i) {
        SDL_DisplayMode mode;
        if (SDL_GetDisplayMode(display, i, &mode) != 0) continue;
        // One mode comes in several pixel formats.
        if (std::ranges::find(modes, to_mode(mode)) == modes.end()) modes.push_back(to_mode(mode));
    }
    return modes;
}

Output output_of(int display) {
    const char* name = SDL_GetDisplayName(display);
    SDL_DisplayMode own{};
    SDL_GetDesktopDisplayMode(display, &own);
    return {name ? name : "", to_mode(own), modes_of(display)};
}

}  // namespace

std::vector<Output> sdl_outputs() {
    std::vector<Output> outputs;
    for (int i = 0; i < SDL_GetNumVideoDisplays(); ++i) outputs.push_back(output_of(i));
    return named_after_connectors(std::move(outputs), in_card_order(list_connectors()));
}

std::vector<Output> list_outputs() {
    // Without a desktop SDL would take the card for itself.
    if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) return outputs_of(list_connectors());
    try {
        const SdlVideo video;
        return sdl_outputs();
    } catch (const Error&) {
        return outputs_of(list_connectors());
    }
}

}  // namespace touchstone
