// Windows and projectors on true X servers without a screen.
#include <SDL.h>
#include <fstream>
#include <optional>

#include "platform/display/gl_error.hpp"
#include "platform/display/projector_display.hpp"
#include "platform/display/sdl_display.hpp"
#include "platform/display/sdl_outputs.hpp"
#include "tests/platform/display/four_fields.hpp"
#include "tests/platform/display/x_screen.hpp"
#include "tests/support/comes_true.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using test::comes_true;
using test::press;
using test::show_four_fields;
using test::window_of_sdl;
using testing::HasSubstr;

/// Goes on drawing until the screen shows just what was drawn, at the place of the window.
bool screen_shows_what_is_drawn(Display& display, const test::XView& view) {
    return comes_true([&] {
        (void)display.should_close();
        show_four_fields(display);
        const auto [x, y, width, height] = view.place(window_of_sdl());
        const Picture drawn = display.read_pixels();
        return drawn.width_px == width && drawn.height_px == height &&
               view.picture(x, y, width, height).rgba == drawn.rgba;
    });
}

class OneOutput : public testing::Test {
  protected:
    void SetUp() override {
        server_.emplace(std::vector<std::string>{"Xvfb", "-noreset", "-screen", "0", "800x600x24"});
        if (!server_->runs()) GTEST_SKIP() << "Xvfb is not installed (package xvfb)";
        view_.emplace();
    }

    std::optional<test::XServer> server_;
    std::optional<test::XView> view_;
};

TEST_F(OneOutput, AWindowShowsThePictureAlsoWhenResized) {
    const auto display = make_sdl_display("test", {320, 200});
    EXPECT_TRUE(screen_shows_what_is_drawn(*display, *view_));
    EXPECT_EQ(display->size_px(), (PixelSize{320, 200}));
    view_->resize(window_of_sdl(), 450, 333);
    EXPECT_TRUE(screen_shows_what_is_drawn(*display, *view_));
    EXPECT_EQ(display->size_px(), (PixelSize{450, 333}));
    EXPECT_EQ(take_gl_errors(), "");
    EXPECT_FALSE(display->is_lost());
}

TEST_F(OneOutput, AWindowThatNobodyReadsShowsTheSame) {
    std::vector<std::uint8_t> seen[2];
    for (const WindowPixels pixels : {WindowPixels::shown_only, WindowPixels::readable}) {
        const auto display = make_sdl_display("test", {320, 200}, pixels);
        const auto look = [&] {
            (void)display->should_close();
            show_four_fields(*display);
            const auto [x, y, width, height] = view_->place(window_of_sdl());
            return view_->picture(x, y, width, height).rgba;
        };
        std::vector<std::uint8_t>& last = seen[pixels == WindowPixels::readable];
        EXPECT_TRUE(comes_true([&] {
            last = look();
            return last.front() != 0 && last == look();
        }));
        EXPECT_EQ(display->read_pixels().rgba.empty(), pixels == WindowPixels::shown_only);
    }
    EXPECT_EQ(seen[0], seen[1]);
}

TEST_F(OneOutput, AWindowIsClosedByItsFrame) {
    const auto display = make_sdl_display("test", {320, 200});
    show_four_fields(*display);
    EXPECT_FALSE(display->should_close());
    view_->ask_to_close(window_of_sdl());
    EXPECT_TRUE(comes_true([&] { return display->should_close(); }));
}

TEST_F(OneOutput, KeysArePassedOnExceptForTheWindowsOwn) {
    const auto display = make_sdl_display("test", {320, 200});
    press(SDLK_o);
    press(SDLK_f);
    press(SDLK_x);
    EXPECT_FALSE(display->should_close());
    EXPECT_EQ(display->take_key(), 'o');
    EXPECT_EQ(display->take_key(), 'x') << "f is for the window itself";
    EXPECT_EQ(display->take_key(), std::nullopt);
}

TEST_F(OneOutput, AProjectorCoversItWithoutACursor) {
    view_->move_pointer(400, 300);
    EXPECT_TRUE(view_->pointer_is_seen());
    {
        const auto display = make_projector_display("test", {});
        EXPECT_TRUE(screen_shows_what_is_drawn(*display, *view_));
        EXPECT_EQ(display->size_px(), (PixelSize{800, 600}));
        EXPECT_EQ(view_->place(window_of_sdl()), (std::array{0, 0, 800, 600}));
        EXPECT_TRUE(comes_true([&] { return !view_->pointer_is_seen(); }));
        EXPECT_FALSE(display->should_close());
        press(SDLK_ESCAPE);
        EXPECT_TRUE(display->should_close());
    }
    EXPECT_TRUE(comes_true([&] { return view_->pointer_is_seen(); }));
}

TEST_F(OneOutput, WrongOutputsAndModesSayWhichThereAre) {
    expect_error(
        [] {
            make_projector_display("test", {"HDMI-A-1", ""});
        },
        ExitStatus::unavailable, testing::AllOf(HasSubstr("\"HDMI-A-1\""), HasSubstr("screen (800x600")));
    expect_error(
        [] {
            make_projector_display("test", {"", "640x480@60"});
        },
        ExitStatus::configuration, HasSubstr("screen has no mode 640x480@60; it has 800x600"));
}

/// An X server whose second output, 640x480 right of the first, comes and goes.
class TwoOutputs : public testing::Test {
  protected:
    void SetUp() override {
        std::ofstream(folder_ / "xorg.conf") << R"(
Section "Device"
    Identifier "none"
    Driver "dummy"
    VideoRam 64000
EndSection
Section "Monitor"
    Identifier "two"
    HorizSync 5.0-1000.0
    VertRefresh 5.0-200.0
EndSection
Section "Screen"
    Identifier "both"
    Device "none"
    Monitor "two"
    DefaultDepth 24
    SubSection "Display"
        Depth 24
        Virtual 2048 1024
    EndSubSection
EndSection
)";
        server_.emplace(std::vector<std::string>{"Xorg", "-noreset", "-novtswitch", "-sharevts", "-config",
                                                 (folder_ / "xorg.conf").string(), "-logfile",
                                                 (folder_ / "xorg.log").string(), "+extension", "RANDR"});
        if (!server_->runs() || std::system("xrandr --output DUMMY0 --mode 1024x768 2>/dev/null") != 0)
            GTEST_SKIP() << "no X server with two outputs: packages xserver-xorg-core, "
                            "xserver-xorg-video-dummy and x11-xserver-utils, as root";
        connect("640x480");
        view_.emplace();
    }

    /// The server only looks what is connected when it is asked: hence the last xrandr.
    static void connect(const std::string& mode) {
        const std::string command = "xrandr --addmode DUMMY1 " + mode + " && xrandr --output DUMMY1 --mode " +
                                    mode + " --right-of DUMMY0 && xrandr >/dev/null";
        ASSERT_EQ(std::system(command.c_str()), 0);
    }
    /// The driver of this server switches an output off but cannot pull its plug: of that only SDL is told.
    void pull_out() const {
        ASSERT_EQ(std::system("xrandr --output DUMMY1 --off"), 0);
        view_->say_pulled_out(window_of_sdl(), 1);
    }

    TemporaryFolder folder_;
    std::optional<test::XServer> server_;
    std::optional<test::XView> view_;
};

TEST_F(TwoOutputs, AreListedByName) {
    const std::vector<Output> outputs = list_outputs();
    ASSERT_EQ(outputs.size(), 2U);
    EXPECT_EQ(outputs[1].name, "DUMMY1");
    EXPECT_EQ(outputs[1].own.size, (PixelSize{640, 480}));
    EXPECT_TRUE(find_output(outputs, "dummy0"));
}

TEST_F(TwoOutputs, AProjectorIsTheLastOneOrTheNamedOne) {
    {
        const auto display = make_projector_display("test", {});
        EXPECT_TRUE(screen_shows_what_is_drawn(*display, *view_));
        EXPECT_EQ(view_->place(window_of_sdl()), (std::array{1024, 0, 640, 480}));
    }
    const auto display = make_projector_display("test", {"DUMMY0", ""});
    EXPECT_TRUE(screen_shows_what_is_drawn(*display, *view_));
    EXPECT_EQ(view_->place(window_of_sdl()), (std::array{0, 0, 1024, 768}));
}

TEST_F(TwoOutputs, AProjectorTakesTheNamedModeWhereTheDesktopHasRoomForIt) {
    {
        const auto display = make_projector_display("test", {"DUMMY1", "640x400@85"});
        EXPECT_TRUE(screen_shows_what_is_drawn(*display, *view_));
        EXPECT_EQ(display->size_px(), (PixelSize{640, 400}));
    }
    const auto display = make_projector_display("test", {"DUMMY1", "800x600@60"});
    EXPECT_TRUE(screen_shows_what_is_drawn(*display, *view_));
    EXPECT_EQ(display->size_px(), (PixelSize{640, 480}));
}

TEST_F(TwoOutputs, AProjectorThatIsPulledOutComesBack) {
    const auto display = make_projector_display("test", {"DUMMY1", ""});
    EXPECT_TRUE(screen_shows_what_is_drawn(*display, *view_));
    pull_out();
    EXPECT_TRUE(comes_true([&] {
        (void)display->should_close();
        show_four_fields(*display);
        return !view_->is_shown(window_of_sdl());
    })) << "it must not lie over the operator's screen";
    for (int frame = 0; frame < 20; ++frame) {
        EXPECT_FALSE(display->should_close());
        show_four_fields(*display);
    }
    EXPECT_FALSE(display->is_lost());
    connect("800x600");
    EXPECT_TRUE(comes_true([&] {
        (void)display->should_close();
        show_four_fields(*display);
        return view_->is_shown(window_of_sdl());
    }));
    EXPECT_TRUE(screen_shows_what_is_drawn(*display, *view_));
    EXPECT_EQ(view_->place(window_of_sdl()), (std::array{1024, 0, 800, 600}));
    EXPECT_EQ(take_gl_errors(), "");
}

}  // namespace
}  // namespace touchstone
