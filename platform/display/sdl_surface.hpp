#pragma once

#include <SDL.h>
#include <deque>
#include <optional>
#include <string>

#include "platform/display/gl_framebuffer.hpp"
#include "platform/display/sdl_display.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

/// SDL's words for what went wrong in `step`, as Error{unavailable}.
Error sdl_error(const std::string& step);

/// SDL's video, from the display server or the bare console.
class SdlVideo {
  public:
    /// Throws Error{unavailable} where there is no screen to show something on.
    SdlVideo();
    ~SdlVideo();
    SdlVideo(const SdlVideo&) = delete;
    SdlVideo& operator=(const SdlVideo&) = delete;
};

/// A window of SDL with its OpenGL ES 3.1 context, vertical sync on where the driver has it.
class SdlWindow {
  public:
    /// `place` is in pixels of the desktop, `flags` are SDL_WindowFlags. Throws Error{unavailable}.
    SdlWindow(const std::string& title, SDL_Rect place, Uint32 flags);
    ~SdlWindow();
    SdlWindow(const SdlWindow&) = delete;
    SdlWindow& operator=(const SdlWindow&) = delete;

    SDL_Window* handle() const { return window_; }
    PixelSize drawable_size() const;
    /// False where it failed.
    bool swap();

  private:
    SDL_Window* window_ = nullptr;
    SDL_GLContext context_ = nullptr;
};

/// What a window shows. A window cannot be read after a swap: where it is to be read, it is drawn into a
/// picture of its own and then copied, which a software GL takes milliseconds for.
class SdlSurface {
  public:
    SdlSurface(const std::string& title, SDL_Rect place, Uint32 flags, WindowPixels pixels);

    SDL_Window* window() const { return window_.handle(); }
    PixelSize size_px() const { return size_; }
    /// Takes over the window's size.
    void begin_frame();
    void present();
    /// Empty where nothing is kept.
    Picture read() const { return picture_ ? picture_->read() : Picture(); }
    /// As Display::is_lost.
    bool is_lost() const;

  private:
    SdlWindow window_;
    PixelSize size_;
    std::optional<GlFramebuffer> picture_;  ///< where it is to be read
    int failed_swaps_ = 0;                  ///< one after the other
};

/// What the user asked for by keys and by closing the window.
class UserWishes {
  public:
    /// Takes the event over where it is such a wish.
    void take(const SDL_Event& event);
    bool wants_to_quit() const { return quits_; }
    std::optional<char> take_key();

  private:
    std::deque<char> keys_;
    bool quits_ = false;
};

}  // namespace touchstone
