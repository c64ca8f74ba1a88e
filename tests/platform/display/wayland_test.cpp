// Windows and projectors on a true Wayland compositor without a screen. It is sway, as SDL 2.26 ends with a
// segmentation fault where there is no seat, and headless weston has none.
#include <SDL.h>
#include <fstream>
#include <gtest/gtest.h>
#include <optional>

#include "platform/display/gl_error.hpp"
#include "platform/display/projector_display.hpp"
#include "platform/display/sdl_display.hpp"
#include "platform/display/sdl_outputs.hpp"
#include "platform/image/png_file.hpp"
#include "tests/platform/display/four_fields.hpp"
#include "tests/support/comes_true.hpp"
#include "tests/support/run_program.hpp"

namespace touchstone {
namespace {

using test::comes_true;
using test::show_four_fields;
namespace fs = std::filesystem;

class Wayland : public testing::Test {
  protected:
    void SetUp() override {
        if (std::system("command -v sway grim setpriv >/dev/null") != 0)
            GTEST_SKIP() << "no Wayland compositor: packages sway and grim";
        // Sway refuses to be root, and then cannot use root's folders.
        fs::permissions(folder_.path(), fs::perms::all);
        std::ofstream(folder_ / "config") << "default_border none\ndefault_floating_border none\n"
                                             "for_window [title=\"test\"] floating enable\n"
                                             "output HEADLESS-1 resolution 400x300 position 0 0\n"
                                             "output HEADLESS-2 resolution 320x240 position 400 0\n";
        for (const auto& [name, value] : environment()) setenv(name.c_str(), value.c_str(), 1);
        std::vector<std::string> command{"/usr/bin/env"};
        if (geteuid() == 0)
            command.insert(command.end(), {"setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"});
        command.insert(command.end(), {"sway", "-c", (folder_ / "config").string()});
        sway_.emplace(command);
        if (!comes_true([&] { return sway("get_outputs >/dev/null 2>&1"); }))
            GTEST_SKIP() << "sway does not start: " << sway_->errors_so_far();
    }
    void TearDown() override {
        if (sway_) sway_->finish(SIGTERM);
        for (const auto& [name, value] : environment()) unsetenv(name.c_str());
    }

    std::vector<std::pair<std::string, std::string>> environment() const {
        return {{"XDG_RUNTIME_DIR", folder_.path().string()},
                {"SWAYSOCK", (folder_ / "ipc").string()},
                {"HOME", folder_.path().string()},
                {"WLR_BACKENDS", "headless"},
                {"WLR_RENDERER", "pixman"},
                {"WLR_LIBINPUT_NO_DEVICES", "1"},
                {"WLR_HEADLESS_OUTPUTS", "2"},
                {"WAYLAND_DISPLAY", "wayland-1"},
                {"SDL_VIDEODRIVER", "wayland"}};
    }
    static bool sway(const std::string& request) {
        return std::system(("swaymsg -t " + request).c_str()) == 0;
    }
    /// Whether somebody before that output sees what was drawn, and nothing else.
    bool output_shows(const std::string& output, Display& display) const {
        const std::string file = (folder_ / "screen.png").string();
        return comes_true([&] {
            (void)display.should_close();
            show_four_fields(display);
            if (std::system(("grim -o " + output + " " + file).c_str()) != 0) return false;
            const Image8 seen = read_png_8(file);
            const Picture drawn = display.read_pixels();
            if (seen.width_px != drawn.width_px || seen.height_px != drawn.height_px) return false;
            return test::same_colors(drawn, seen.pixels, seen.channels);
        });
    }

    TemporaryFolder folder_;
    std::optional<test::RunningProgram> sway_;
};

TEST_F(Wayland, AWindowFillsTheScreenGoesBackAndIsClosed) {
    const auto display = make_sdl_display("test", {200, 150});
    const auto has_size = [&](PixelSize size) {
        return comes_true([&] {
            (void)display->should_close();
            show_four_fields(*display);
            return display->size_px() == size;
        });
    };
    EXPECT_TRUE(has_size({200, 150}));
    test::press(SDLK_f);
    EXPECT_TRUE(output_shows("HEADLESS-1", *display) || output_shows("HEADLESS-2", *display));
    test::press(SDLK_f);
    EXPECT_TRUE(has_size({200, 150}));
    EXPECT_EQ(take_gl_errors(), "");
    EXPECT_TRUE(sway("command '[title=\"test\"] kill' >/dev/null"));
    EXPECT_TRUE(comes_true([&] { return display->should_close(); }));
}

TEST_F(Wayland, AProjectorCoversTheOutputThatWasNamed) {
    const std::vector<Output> outputs = list_outputs();
    ASSERT_EQ(outputs.size(), 2U);
    for (const Output& output : outputs) {
        const auto display = make_projector_display("test", {output.name, ""});
        const bool first = output.own.size == PixelSize{400, 300};
        EXPECT_TRUE(output_shows(first ? "HEADLESS-1" : "HEADLESS-2", *display)) << output.name;
        EXPECT_EQ(display->size_px(), output.own.size);
        EXPECT_FALSE(display->is_lost());
    }
}

}  // namespace
}  // namespace touchstone
