#include "platform/display/sdl_display.hpp"

#include <GLES3/gl31.h>
#include <cstdlib>
#include <gtest/gtest.h>
#include <iostream>

#include "platform/display/gl_error.hpp"
#include "platform/system/error.hpp"

namespace touchstone {
namespace {

// Each runs in a child process: SDL reads its video driver from the environment, and a driver may keep
// threads.

void draw_one_frame_on(const char* video_driver) {
    setenv("SDL_VIDEODRIVER", video_driver, 1);
    try {
        const auto display = make_sdl_display("test", {160, 90});
        display->begin_frame();
        glClearColor(0.f, 1.f, 0.f, 1.f);
        glClear(GL_COLOR_BUFFER_BIT);
        display->present();
        const Picture picture = display->read_pixels();
        const bool green = picture.rgba.at(0) == 0 && picture.rgba.at(1) == 255;
        std::cerr << picture.width_px << "x" << picture.height_px << (green ? " green" : " not green")
                  << " errors[" << take_gl_errors() << "] " << (display->should_close() ? "closing" : "open")
                  << '\n';
    } catch (const Error& error) {
        std::cerr << error.what() << '\n';
        std::_Exit(static_cast<int>(error.status()));
    }
    std::_Exit(0);
}

TEST(SdlDisplayDeathTest, OffscreenDriverShowsAFrame) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(draw_one_frame_on("offscreen"), testing::ExitedWithCode(0), "160x90 green errors\\[\\] open");
}

TEST(SdlDisplayDeathTest, NoDisplayServerIsOneLineWithAdvice) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    setenv("DISPLAY", ":9999", 1);
    EXPECT_EXIT(draw_one_frame_on("x11"), testing::ExitedWithCode(69), "No window: .*--display headless");
}

}  // namespace
}  // namespace touchstone
