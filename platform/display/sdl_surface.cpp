#include "platform/display/sdl_surface.hpp"

namespace touchstone {

namespace {

constexpr int swaps_until_lost = 10;
constexpr std::size_t most_keys = 32;

/// Where SDL finds no display server it takes its offscreen driver, in which nobody would see the window.
/// Named in SDL_VIDEODRIVER it is what the user wants.
bool shows_a_screen() {
    const std::string driver = SDL_GetCurrentVideoDriver();
    return (driver != "offscreen" && driver != "dummy") || SDL_GetHint(SDL_HINT_VIDEODRIVER) ||
           SDL_getenv("SDL_VIDEODRIVER");
}

/// One that says when the driver has given it up, where the driver can.
SDL_GLContext make_context(SDL_Window* window) {
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_RESET_NOTIFICATION, SDL_GL_CONTEXT_RESET_LOSE_CONTEXT);
    if (SDL_GLContext context = SDL_GL_CreateContext(window)) return context;
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_RESET_NOTIFICATION, SDL_GL_CONTEXT_RESET_NO_NOTIFICATION);
    return SDL_GL_CreateContext(window);
}

bool context_was_reset() {
    using ResetStatus = GLenum (*)();
    for (const char* name : {"glGetGraphicsResetStatus", "glGetGraphicsResetStatusKHR"}) {
        if (SDL_strcmp(name, "glGetGraphicsResetStatusKHR") == 0 &&
            SDL_GL_ExtensionSupported("GL_KHR_robustness") == SDL_FALSE)
            continue;
        if (const auto status = reinterpret_cast<ResetStatus>(SDL_GL_GetProcAddress(name)))
            return status() != GL_NO_ERROR;
    }
    return false;
}

}  // namespace

Error sdl_error(const std::string& step) {
    return {ExitStatus::unavailable, "No window: " + step + " failed (" + SDL_GetError() +
                                         "); start from a desktop session, or use --display headless"};
}

SdlVideo::SdlVideo() {
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");  // SIGTERM belongs to the application
    SDL_SetHint(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "0");
    SDL_SetHint(SDL_HINT_VIDEO_MINIMIZE_ON_FOCUS_LOSS, "0");
    if (SDL_InitSubSystem(SDL_INIT_VIDEO) != 0) throw sdl_error("starting SDL video");
    if (shows_a_screen()) return;
    SDL_SetError("no display server and no screen found");
    const Error error = sdl_error("starting SDL video");
    SDL_QuitSubSystem(SDL_INIT_VIDEO);
    throw error;
}

SdlVideo::~SdlVideo() { SDL_QuitSubSystem(SDL_INIT_VIDEO); }

SdlWindow::SdlWindow(const std::string& title, SDL_Rect place, Uint32 flags) {
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_ES);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 3);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 1);
    window_ = SDL_CreateWindow(title.c_str(), place.x, place.y, place.w, place.h,
                               flags | SDL_WINDOW_OPENGL | SDL_WINDOW_ALLOW_HIGHDPI);
    if (!window_) throw sdl_error("opening a window");
    context_ = make_context(window_);
    if (!context_) {
        const Error error = sdl_error("making an OpenGL ES 3.1 context");
        SDL_DestroyWindow(window_);
        throw error;
    }
    SDL_GL_SetSwapInterval(1);
}

SdlWindow::~SdlWindow() {
    SDL_GL_DeleteContext(context_);
    SDL_DestroyWindow(window_);
}

PixelSize SdlWindow::drawable_size() const {
    PixelSize size;
    SDL_GL_GetDrawableSize(window_, &size.width_px, &size.height_px);
    return size;
}

bool SdlWindow::swap() {
    SDL_ClearError();
    SDL_GL_SwapWindow(window_);
    return SDL_GetError()[0] == '\0';
}

SdlSurface::SdlSurface(const std::string& title, SDL_Rect place, Uint32 flags, WindowPixels pixels)
    : window_(title, place, flags), size_(window_.drawable_size()) {
    if (pixels == WindowPixels::readable) picture_.emplace(size_);
}

void SdlSurface::begin_frame() {
    const PixelSize size = window_.drawable_size();
    if (size != size_ && size.width_px > 0 && size.height_px > 0) {
        size_ = size;
        if (picture_) picture_.emplace(size);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, picture_ ? picture_->id() : 0);
    glViewport(0, 0, size_.width_px, size_.height_px);
}

void SdlSurface::present() {
    if (picture_) {
        glBindFramebuffer(GL_READ_FRAMEBUFFER, picture_->id());
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
        glBlitFramebuffer(0, 0, size_.width_px, size_.height_px, 0, 0, size_.width_px, size_.height_px,
                          GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
    failed_swaps_ = window_.swap() ? 0 : failed_swaps_ + 1;
}

bool SdlSurface::is_lost() const { return failed_swaps_ >= swaps_until_lost || context_was_reset(); }

void UserWishes::take(const SDL_Event& event) {
    if (event.type == SDL_QUIT) quits_ = true;
    if (event.type != SDL_KEYDOWN || event.key.repeat != 0) return;
    const SDL_Keycode key = event.key.keysym.sym;
    if (key == SDLK_ESCAPE) quits_ = true;
    if (key >= SDLK_SPACE && key < SDLK_DELETE && keys_.size() < most_keys)
        keys_.push_back(static_cast<char>(key));
}

std::optional<char> UserWishes::take_key() {
    if (keys_.empty()) return std::nullopt;
    const char key = keys_.front();
    keys_.pop_front();
    return key;
}

}  // namespace touchstone
