#include "platform/display/sdl_display.hpp"

#include <GLES3/gl31.h>
#include <SDL.h>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <iostream>
#include <string>

#include "platform/display/gl_error.hpp"
#include "platform/system/error.hpp"

namespace touchstone {
namespace {

// Each display runs in a child process: SDL reads its video driver from the environment, and a driver may
// keep threads.

/// Draws a frame of the display's size in green and says what it found.
void show_green_frame(Display& display) {
    display.begin_frame();
    glClearColor(0.f, 1.f, 0.f, 1.f);
    glClear(GL_COLOR_BUFFER_BIT);
    display.present();
    const Picture picture = display.read_pixels();
    const bool green = picture.rgba.front() == 0 && picture.rgba.at(picture.rgba.size() - 3) == 255;
    std::cerr << picture.width_px << "x" << picture.height_px << (green ? " green" : " not green")
              << " errors[" << take_gl_errors() << "]";
}

void resize_window(int width_px, int height_px) {
    SDL_Window* window = SDL_GetWindowFromID(1);
    if (!window) return;
    SDL_SetWindowSize(window, width_px, height_px);
    SDL_PumpEvents();
}

void press_escape() {
    SDL_Event event{};
    event.type = SDL_KEYDOWN;
    event.key.keysym.sym = SDLK_ESCAPE;
    SDL_PushEvent(&event);
}

[[noreturn]] void use_a_window() {
    try {
        const auto display = make_sdl_display("test", {160, 90});
        show_green_frame(*display);
        resize_window(200, 150);
        std::cerr << ", then ";
        show_green_frame(*display);
        std::cerr << (display->should_close() ? " closing" : " open");
        press_escape();
        std::cerr << (display->should_close() ? " closing" : " open") << '\n';
    } catch (const Error& error) {
        std::cerr << error.what() << '\n';
        std::_Exit(static_cast<int>(error.status()));
    }
    std::_Exit(0);
}

constexpr const char* what_a_window_says =
    "160x90 green errors\\[\\], then 200x150 green errors\\[\\] open closing";

/// On the driver named in SDL_VIDEODRIVER, by default the offscreen one.
TEST(SdlDisplayDeathTest, WindowShowsResizesAndCloses) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    setenv("SDL_VIDEODRIVER", "offscreen", 0);
    EXPECT_EXIT(use_a_window(), testing::ExitedWithCode(0), what_a_window_says);
    unsetenv("SDL_VIDEODRIVER");
}

TEST(SdlDisplayDeathTest, NoDisplayServerIsOneLineWithAdvice) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    unsetenv("SDL_VIDEODRIVER");
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    EXPECT_EXIT(use_a_window(), testing::ExitedWithCode(69), "No window: .*--display headless");
}

TEST(SdlDisplayDeathTest, UnreachableDisplayServerIsOneLineWithAdvice) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    setenv("SDL_VIDEODRIVER", "x11", 1);
    setenv("DISPLAY", ":9999", 1);
    EXPECT_EXIT(use_a_window(), testing::ExitedWithCode(69), "No window: .*--display headless");
    unsetenv("SDL_VIDEODRIVER");
}

TEST(SdlDisplay, X11WindowShowsResizesAndCloses) {
    if (std::system("command -v xvfb-run >/dev/null") != 0)
        GTEST_SKIP() << "xvfb-run is not installed (package xvfb)";
    const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
    const std::string command =
        "SDL_VIDEODRIVER=x11 xvfb-run -a '" + self + "' --gtest_filter=*.WindowShows* >&2";
    EXPECT_EQ(std::system(command.c_str()), 0);
}

}  // namespace
}  // namespace touchstone
