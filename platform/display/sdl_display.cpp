#include "platform/display/sdl_display.hpp"

#include "platform/display/sdl_surface.hpp"

namespace touchstone {

namespace {

class SdlDisplay : public Display {
  public:
    SdlDisplay(const std::string& title, PixelSize size, WindowPixels pixels)
        : surface_(title, {SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, size.width_px, size.height_px},
                   SDL_WINDOW_RESIZABLE, pixels) {}

    PixelSize size_px() const override { return surface_.size_px(); }
    void begin_frame() override { surface_.begin_frame(); }
    void present() override { surface_.present(); }
    Picture read_pixels() override { return surface_.read(); }
    bool is_lost() const override { return surface_.is_lost(); }
    std::optional<char> take_key() override { return wishes_.take_key(); }

    bool should_close() override {
        SDL_Event event;
        while (SDL_PollEvent(&event)) {
            if (event.type == SDL_KEYDOWN && event.key.repeat == 0 && event.key.keysym.sym == SDLK_f)
                toggle_full_screen();
            else
                wishes_.take(event);
        }
        return wishes_.wants_to_quit();
    }

  private:
    void toggle_full_screen() {
        const bool full = (SDL_GetWindowFlags(surface_.window()) & SDL_WINDOW_FULLSCREEN) != 0;
        SDL_SetWindowFullscreen(surface_.window(), full ? 0U : Uint32{SDL_WINDOW_FULLSCREEN_DESKTOP});
    }

    SdlVideo video_;
    SdlSurface surface_;
    UserWishes wishes_;
};

}  // namespace

std::unique_ptr<Display> make_sdl_display(const std::string& title, PixelSize size, WindowPixels pixels) {
    return std::make_unique<SdlDisplay>(title, size, pixels);
}

}  // namespace touchstone
