#include "platform/display/headless_display.hpp"

#include <GLES3/gl31.h>
#include <array>
#include <cstdlib>
#include <gtest/gtest.h>
#include <iostream>
#include <thread>

#include "platform/display/gl_error.hpp"
#include "platform/display/gl_framebuffer.hpp"
#include "platform/system/error.hpp"

namespace touchstone {
namespace {

std::array<int, 4> pixel(const Picture& picture, int x, int y) {
    const std::uint8_t* p =
        &picture.rgba[4 * static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width_px) +
                      4 * static_cast<std::size_t>(x)];
    return {p[0], p[1], p[2], p[3]};
}

void clear_box(int x, int y, int width, int height, float red, float green, float blue) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(x, y, width, height);
    glClearColor(red, green, blue, 1.f);
    glClear(GL_COLOR_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST);
}

TEST(HeadlessDisplay, ReadsBackWhatWasClearedTopRowFirst) {
    const auto display = make_headless_display({64, 40});
    EXPECT_EQ(display->size_px(), (PixelSize{64, 40}));
    display->begin_frame();
    clear_box(0, 0, 64, 40, 1.f, 0.f, 0.f);
    clear_box(0, 30, 64, 10, 0.f, 0.f, 1.f);  // GL counts rows from the bottom: these are the upper ten
    display->present();

    const Picture picture = display->read_pixels();
    ASSERT_EQ(picture.rgba.size(), 64U * 40U * 4U);
    EXPECT_EQ(pixel(picture, 5, 0), (std::array{0, 0, 255, 255}));
    EXPECT_EQ(pixel(picture, 5, 9), (std::array{0, 0, 255, 255}));
    EXPECT_EQ(pixel(picture, 5, 10), (std::array{255, 0, 0, 255}));
    EXPECT_EQ(pixel(picture, 63, 39), (std::array{255, 0, 0, 255}));
    EXPECT_EQ(take_gl_errors(), "");
    EXPECT_FALSE(display->should_close());
}

TEST(HeadlessDisplay, WorksOnAThreadOfItsOwnWhileAnotherLives) {
    const auto outer = make_headless_display({16, 16});
    std::array<int, 4> seen{};
    std::thread([&seen] {
        const auto inner = make_headless_display({8, 8});
        inner->begin_frame();
        clear_box(0, 0, 8, 8, 0.f, 1.f, 0.f);
        inner->present();
        seen = pixel(inner->read_pixels(), 4, 4);
    }).join();
    EXPECT_EQ(seen, (std::array{0, 255, 0, 255}));

    outer->begin_frame();
    clear_box(0, 0, 16, 16, 1.f, 1.f, 1.f);
    EXPECT_EQ(pixel(outer->read_pixels(), 4, 4), (std::array{255, 255, 255, 255}));
    EXPECT_EQ(take_gl_errors(), "");
}

TEST(HeadlessDisplay, TooLargeAPictureIsAnError) {
    EXPECT_THROW(make_headless_display({1 << 20, 16}), Error);
}

TEST(GlError, TakesEachErrorOnce) {
    const auto display = make_headless_display({8, 8});
    glEnable(GL_RGBA);
    EXPECT_EQ(take_gl_errors(), "0x0500");
    EXPECT_EQ(take_gl_errors(), "");
}

/// The child process for the death test: EGL reads its list of drivers once a process, from the environment.
void start_without_drivers() {
    setenv("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent", 1);
    setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "", 1);
    try {
        make_headless_display({64, 64});
    } catch (const Error& error) {
        std::cerr << error.what() << '\n';
        std::_Exit(static_cast<int>(error.status()));
    }
    std::_Exit(0);
}

TEST(HeadlessDisplayDeathTest, NoDriverIsOneClearLine) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(start_without_drivers(), testing::ExitedWithCode(69),
                "No OpenGL ES 3.1 without a screen: eglGetPlatformDisplay failed .*install");
}

}  // namespace
}  // namespace touchstone
