// The presentation loop on displays that fail or hang.
#include "app/presentation.hpp"

#include <atomic>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <thread>

#include "app/two_loops.hpp"
#include "platform/display/headless_display.hpp"
#include "platform/system/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

/// Draws off screen; a test says what happens when it shows.
class FakeDisplay : public Display {
  public:
    explicit FakeDisplay(std::function<void()> on_present, const bool* lost = nullptr)
        : on_present_(std::move(on_present)), lost_(lost) {}

    PixelSize size_px() const override { return screen_->size_px(); }
    void begin_frame() override { screen_->begin_frame(); }
    void present() override { on_present_(); }
    Picture read_pixels() override { return screen_->read_pixels(); }
    bool should_close() override { return false; }
    bool is_lost() const override { return lost_ && *lost_; }

  private:
    std::unique_ptr<Display> screen_ = make_headless_display({160, 120});
    std::function<void()> on_present_;
    const bool* lost_;
};

int lines_in(const std::filesystem::path& file) {
    std::ifstream stream(file);
    int lines = 0;
    for (std::string line; std::getline(stream, line);) ++lines;
    return lines;
}

TEST(Presentation, ALostDisplayIsMadeAnewWhenItCanBe) {
    bool lost = false;
    int made = 0, shown = 0;
    Presentation presentation(RunOptions{}, [&]() -> std::unique_ptr<Display> {
        if (made++ == 1) throw Error(ExitStatus::unavailable, "still gone");
        lost = false;
        return std::make_unique<FakeDisplay>([&] { ++shown; }, &lost);
    });
    const auto frame = [&] {
        presentation.draw({});
        presentation.show();
    };
    frame();
    EXPECT_EQ(made, 1);
    lost = true;
    frame();
    EXPECT_EQ(shown, 2);
    EXPECT_FALSE(presentation.should_close());
    frame();
    EXPECT_EQ(made, 2) << "in vain";
    EXPECT_EQ(shown, 2);
    while (made == 2) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        frame();
    }
    EXPECT_EQ(made, 3);
    EXPECT_EQ(shown, 3);
}

/// The first picture is shown only once the sinks have got 40 frames more.
TEST(TwoLoops, AScreenThatHangsHoldsUpNoTouches) {
    const TemporaryFolder folder;
    RunOptions options;
    options.config.sensor_uri = "sim:flat?hands=1&seed=3&rate=30";
    options.config.tuio.enabled = false;
    options.config.interaction.background.volume.size_vox = 64;
    options.events_file = (folder / "events.jsonl").string();
    options.frames = 60;
    bool hung = false, went_on = false;
    const auto hang = [&] {
        if (std::exchange(hung, true)) return;
        const int before = lines_in(*options.events_file);
        for (int look = 0; look < 1500 && !went_on; ++look) {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            went_on = lines_in(*options.events_file) >= before + 40;
        }
    };
    TerminationSignals signals;
    Perception perception(options);
    Presentation presentation(options, [&] { return std::make_unique<FakeDisplay>(hang); });
    ServiceWatch watch;
    run_two_loops(perception, presentation, signals, watch);
    EXPECT_TRUE(hung);
    EXPECT_TRUE(went_on);
    EXPECT_EQ(lines_in(*options.events_file), 60);
}

}  // namespace
}  // namespace touchstone
