#include "platform/display/projector_display.hpp"

#include <chrono>

#include "platform/display/connectors.hpp"
#include "platform/display/sdl_outputs.hpp"
#include "platform/display/sdl_surface.hpp"
#include "platform/system/log.hpp"

namespace touchstone {

namespace {

constexpr std::chrono::seconds between_looks{1};

bool on_bare_console() { return SDL_strcasecmp(SDL_GetCurrentVideoDriver(), "KMSDRM") == 0; }

/// SDL's own message would not tell what a console lacks.
class ProjectorVideo {
  public:
    ProjectorVideo() try : video_() {
    } catch (const Error& error) {
        const bool desktop = SDL_getenv("DISPLAY") || SDL_getenv("WAYLAND_DISPLAY");
        const std::string problem = desktop ? std::string() : console_problem();
        if (problem.empty()) throw;
        throw Error(error.status(), "No projector: " + problem);
    }

  private:
    SdlVideo video_;
};

/// Whether the other outputs leave room. An X server refuses a mode that reaches out of its screen, upon
/// which Xlib would end the program.
bool fits_desktop(int display, PixelSize size) {
    if (SDL_strcmp(SDL_GetCurrentVideoDriver(), "x11") != 0) return true;
    SDL_Rect place{}, desktop{}, other{};
    SDL_GetDisplayBounds(display, &place);
    for (int i = 0; i < SDL_GetNumVideoDisplays(); ++i) {
        SDL_GetDisplayBounds(i, &other);
        SDL_UnionRect(&desktop, &other, &desktop);
    }
    return place.x + size.width_px <= desktop.x + desktop.w &&
           place.y + size.height_px <= desktop.y + desktop.h;
}

/// The output and mode that were chosen at the start.
class ChosenOutput {
  public:
    explicit ChosenOutput(const ProjectorConfig& config) {
        const std::vector<Output> outputs = sdl_outputs();
        const Output& output = choose_output(outputs, config.output);
        name_ = output.name;
        mode_ = choose_mode(output, config.mode);
        is_own_mode_ = config.mode.empty();
    }

    const std::string& name() const { return name_; }
    /// SDL's number of it; nothing while it is not connected.
    std::optional<int> display() const {
        const auto found = find_output(sdl_outputs(), name_);
        if (!found || (on_bare_console() && !is_connected(name_.substr(0, name_.find(' ')))))
            return std::nullopt;
        return static_cast<int>(*found);
    }
    SDL_Rect bounds() const {
        SDL_Rect rect{};
        SDL_GetDisplayBounds(display().value_or(0), &rect);
        return rect;
    }
    /// As near to the chosen mode as what is plugged in now allows; nothing for the output's own.
    std::optional<SDL_DisplayMode> sdl_mode(int display) const {
        const SDL_DisplayMode wanted{0, mode_.size.width_px, mode_.size.height_px, mode_.rate_hz, nullptr};
        SDL_DisplayMode closest{};
        if (is_own_mode_ || !SDL_GetClosestDisplayMode(display, &wanted, &closest)) return std::nullopt;
        if (fits_desktop(display, {closest.w, closest.h})) return closest;
        log_warning(
            "the desktop has no room for {} on {}, which stays in its own mode; make room with "
            "xrandr or the desktop's settings, and leave display.mode empty",
            to_text(mode_), name_);
        return std::nullopt;
    }

  private:
    std::string name_;
    ScreenMode mode_;
    bool is_own_mode_ = true;
};

class ProjectorDisplay : public Display {
  public:
    ProjectorDisplay(const std::string& title, const ProjectorConfig& config)
        : output_(config), surface_(title, output_.bounds(), SDL_WINDOW_BORDERLESS, config.pixels) {
        SDL_ShowCursor(SDL_DISABLE);
        SDL_DisableScreenSaver();
        follow_output();
        log_info("showing on {}", output_.name());
    }

    PixelSize size_px() const override { return surface_.size_px(); }
    void begin_frame() override { surface_.begin_frame(); }
    void present() override {
        if (visible_) surface_.present();
    }
    Picture read_pixels() override { return surface_.read(); }
    bool is_lost() const override { return surface_.is_lost(); }
    std::optional<char> take_key() override { return wishes_.take_key(); }

    bool should_close() override {
        bool outputs_changed = false;
        SDL_Event event;
        while (SDL_PollEvent(&event)) {
            outputs_changed |= event.type == SDL_DISPLAYEVENT;
            wishes_.take(event);
        }
        if (outputs_changed || console_changed()) follow_output();
        return wishes_.wants_to_quit();
    }

  private:
    /// On a bare console SDL tells nothing of what is plugged in.
    bool console_changed() {
        const auto now = std::chrono::steady_clock::now();
        if (!on_bare_console() || now < next_look_) return false;
        next_look_ = now + between_looks;
        return output_.display().has_value() != visible_;
    }

    void follow_output() {
        const std::optional<int> display = output_.display();
        if (!display) {
            if (visible_) log_warning("{} is gone: drawing goes on unseen until it is back", output_.name());
            SDL_HideWindow(surface_.window());
        } else {
            if (was_gone_) log_info("{} is back", output_.name());
            cover(*display);
        }
        visible_ = display.has_value();
        was_gone_ = !visible_;
    }

    void cover(int display) {
        SDL_Window* window = surface_.window();
        SDL_Rect place{};
        SDL_GetDisplayBounds(display, &place);
        SDL_SetWindowFullscreen(window, 0);
        SDL_SetWindowPosition(window, place.x, place.y);
        const std::optional<SDL_DisplayMode> mode = output_.sdl_mode(display);
        if (mode) SDL_SetWindowDisplayMode(window, &*mode);
        // Without a window manager full screen alone does not change its size.
        SDL_SetWindowSize(window, mode ? mode->w : place.w, mode ? mode->h : place.h);
        SDL_ShowWindow(window);
        SDL_SetWindowFullscreen(window, mode ? SDL_WINDOW_FULLSCREEN : SDL_WINDOW_FULLSCREEN_DESKTOP);
    }

    ProjectorVideo video_;
    ChosenOutput output_;
    SdlSurface surface_;
    UserWishes wishes_;
    bool visible_ = false, was_gone_ = false;
    std::chrono::steady_clock::time_point next_look_{};
};

}  // namespace

std::unique_ptr<Display> make_projector_display(const std::string& title, const ProjectorConfig& config) {
    return std::make_unique<ProjectorDisplay>(title, config);
}

}  // namespace touchstone
