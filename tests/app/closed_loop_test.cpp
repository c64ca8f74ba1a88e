// The projector, the table and a finger, all simulated: what is drawn on a curved surface is hit there.
#include <gtest/gtest.h>
#include <optional>
#include <vector>

#include "app/calibrate_command.hpp"
#include "app/displays.hpp"
#include "app/perception.hpp"
#include "app/presentation.hpp"
#include "platform/display/headless_display.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

constexpr const char* table = "sim:curved?projector=1&seed=11";

constexpr PixelSize small{640, 400};  // a picture of another size is stretched: a quarter of the work

using IsColor = bool (*)(const std::uint8_t* rgba);
bool is_red(const std::uint8_t* rgba) { return rgba[0] > 220 && rgba[1] < 120 && rgba[2] < 120; }
/// Of the line under a chosen button.
bool is_accent(const std::uint8_t* rgba) { return rgba[2] > 110 && rgba[2] > rgba[0] + 50; }

/// Places of a colour within `reach_px` of a place.
std::vector<Eigen::Vector2f> places_of(const Picture& picture, IsColor is_color,
                                       const Eigen::Vector2f& near_px, float reach_px) {
    std::vector<Eigen::Vector2f> places;
    for (int y = 0; y < picture.height_px; ++y) {
        for (int x = 0; x < picture.width_px; ++x) {
            const Eigen::Vector2f place(static_cast<float>(x), static_cast<float>(y));
            if ((place - near_px).norm() < reach_px &&
                is_color(&picture.rgba[4 * static_cast<std::size_t>(y * picture.width_px + x)]))
                places.push_back(place);
        }
    }
    return places;
}

Eigen::Vector2f middle_of(const std::vector<Eigen::Vector2f>& places) {
    Eigen::Vector2f sum = Eigen::Vector2f::Zero();
    for (const Eigen::Vector2f& place : places) sum += place;
    return sum / static_cast<float>(places.size());
}

RunOptions options_for(const std::string& sensor, const std::string& calibration) {
    RunOptions options;
    options.config.sensor_uri = sensor;
    options.config.projector.file = calibration;
    options.config.tuio.enabled = false;
    options.config.log_level = "warning";
    options.pace = Pace::step;
    return options;
}

void calibrate(const std::string& calibration) {
    CalibrateOptions options;
    options.config = options_for(std::string(table) + "&hands=0", calibration).config;
    options.pace = Pace::step;
    ASSERT_EQ(calibrate_command(options), ExitStatus::ok);
}

/// A finger is told the pixel of the palette's red, as the projector throws it, and red is chosen.
TEST(ClosedLoop, AButtonDrawnOnACurvedSurfaceIsHit) {
    const TemporaryFolder folder;
    const std::string calibration = (folder / "projector").string();
    ASSERT_NO_FATAL_FAILURE(calibrate(calibration));
    const RunOptions options = options_for(std::string(table) + "&hands=1&guided=1", calibration);
    Perception perception(options);
    SimulatedProjector* projector = nullptr;
    Presentation presentation(options, [&]() -> std::unique_ptr<Display> {
        auto made =
            std::make_unique<SimulatedProjector>(make_headless_display(small), projected_picture_name());
        projector = made.get();
        return made;
    });
    constexpr int live = 50, asked = 60, goes = 170, gone = 215;
    const Eigen::Vector2f middle_px(320.0f, 200.0f);
    constexpr float reach_px = 13.0f;  // its own line, not its neighbour
    Eigen::Vector2f red_px = middle_px;
    for (int frame = 0; frame < gone; ++frame) {
        const std::optional<TableFrame> shown = perception.step();
        ASSERT_TRUE(shown);
        if (frame < live) continue;
        ASSERT_EQ(shown->state, "live");
        presentation.draw(*shown);
        presentation.show();
        if (frame == asked) {
            const auto red = places_of(projector->read_pixels(), is_red, middle_px, 1000.0f);
            ASSERT_GT(red.size(), 20U) << "the palette's red";
            red_px = middle_of(red);
            EXPECT_TRUE(places_of(projector->read_pixels(), is_accent, red_px, reach_px).empty());
            projector->set_aim(std::array{red_px.x(), red_px.y()});
        }
        if (frame == goes) projector->set_aim(std::nullopt);
    }
    EXPECT_GT(places_of(projector->read_pixels(), is_accent, red_px, reach_px).size(), 5U)
        << "red is underlined";
}

}  // namespace
}  // namespace touchstone
