#include "platform/display/sdl_display.hpp"

#include <SDL.h>

#include "platform/display/gl_framebuffer.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

namespace {

Error sdl_error(const char* step) {
    return {ExitStatus::unavailable, std::string("No window: ") + step + " failed (" + SDL_GetError() +
                                         "); start from a desktop session, or use --display headless"};
}

class SdlVideo {
  public:
    SdlVideo() {
        SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");  // SIGTERM belongs to the application
        SDL_SetHint(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "0");
        if (SDL_InitSubSystem(SDL_INIT_VIDEO) != 0) throw sdl_error("starting SDL video");
        if (!shows_a_screen()) {
            SDL_SetError("no display server and no screen found");
            const Error error = sdl_error("starting SDL video");
            SDL_QuitSubSystem(SDL_INIT_VIDEO);
            throw error;
        }
    }
    ~SdlVideo() { SDL_QuitSubSystem(SDL_INIT_VIDEO); }
    SdlVideo(const SdlVideo&) = delete;
    SdlVideo& operator=(const SdlVideo&) = delete;

  private:
    /// Where SDL finds no display server it takes its offscreen driver, in which nobody would see the window.
    /// Named in SDL_VIDEODRIVER it is what the user wants.
    static bool shows_a_screen() {
        const std::string driver = SDL_GetCurrentVideoDriver();
        return (driver != "offscreen" && driver != "dummy") || SDL_GetHint(SDL_HINT_VIDEODRIVER) ||
               SDL_getenv("SDL_VIDEODRIVER");
    }
};

class SdlWindow {
  public:
    SdlWindow(const std::string& title, PixelSize size) {
        SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_ES);
        SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 3);
        SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 1);
        window_ = SDL_CreateWindow(title.c_str(), SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                                   size.width_px, size.height_px,
                                   SDL_WINDOW_OPENGL | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI);
        if (!window_) throw sdl_error("opening a window");
        context_ = SDL_GL_CreateContext(window_);
        if (!context_) {
            const Error error = sdl_error("making an OpenGL ES 3.1 context");
            SDL_DestroyWindow(window_);
            throw error;
        }
        SDL_GL_SetSwapInterval(1);
    }
    ~SdlWindow() {
        SDL_GL_DeleteContext(context_);
        SDL_DestroyWindow(window_);
    }
    SdlWindow(const SdlWindow&) = delete;
    SdlWindow& operator=(const SdlWindow&) = delete;

    void swap() { SDL_GL_SwapWindow(window_); }
    PixelSize drawable_size() const {
        PixelSize size;
        SDL_GL_GetDrawableSize(window_, &size.width_px, &size.height_px);
        return size;
    }

  private:
    SDL_Window* window_ = nullptr;
    SDL_GLContext context_ = nullptr;
};

/// Draws into a picture of its own, which present() copies to the window: after a swap a window cannot be
/// read.
class SdlDisplay : public Display {
  public:
    SdlDisplay(const std::string& title, PixelSize size)
        : window_(title, size), screen_(window_.drawable_size()) {}

    PixelSize size_px() const override { return screen_.size_px(); }

    void begin_frame() override {
        const PixelSize size = window_.drawable_size();
        if (size != screen_.size_px() && size.width_px > 0 && size.height_px > 0)
            screen_ = GlFramebuffer(size);
        screen_.bind();
    }

    void present() override {
        const PixelSize size = screen_.size_px();
        glBindFramebuffer(GL_READ_FRAMEBUFFER, screen_.id());
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
        glBlitFramebuffer(0, 0, size.width_px, size.height_px, 0, 0, size.width_px, size.height_px,
                          GL_COLOR_BUFFER_BIT, GL_NEAREST);
        window_.swap();
    }

    Picture read_pixels() override { return screen_.read(); }

    bool should_close() override {
        SDL_Event event;
        while (SDL_PollEvent(&event)) {
            const bool escape = event.type == SDL_KEYDOWN && event.key.keysym.sym == SDLK_ESCAPE;
            if (event.type == SDL_QUIT || escape) closing_ = true;
        }
        return closing_;
    }

  private:
    SdlVideo video_;
    SdlWindow window_;
    GlFramebuffer screen_;
    bool closing_ = false;
};

}  // namespace

std::unique_ptr<Display> make_sdl_display(const std::string& title, PixelSize size) {
    return std::make_unique<SdlDisplay>(title, size);
}

}  // namespace touchstone
