// The projector, the table and a finger, all simulated: what is drawn on a curved surface is hit there.
#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <optional>

#include "app/calibrate_command.hpp"
#include "app/displays.hpp"
#include "app/perception.hpp"
#include "app/presentation.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

constexpr const char* table = "sim:curved?projector=1&seed=11";

/// Middle of what is lit in the picture's part above `until_y_px`.
std::optional<Eigen::Vector2f> lit_middle(const Picture& picture, int until_y_px, int* lit = nullptr) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    int count = 0;
    for (int y = 0; y < until_y_px; ++y) {
        for (int x = 0; x < picture.width_px; ++x) {
            const std::uint8_t* rgba = &picture.rgba[4 * static_cast<std::size_t>(y * picture.width_px + x)];
            if (std::max({rgba[0], rgba[1], rgba[2]}) < 16) continue;
            sum += Eigen::Vector2d(x, y);
            ++count;
        }
    }
    if (lit) *lit = count;
    if (count == 0) return std::nullopt;
    return Eigen::Vector2f((sum / count).cast<float>());
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

/// A guided finger is told the pixel of the menu's button, as the projector throws it: the menu opens.
TEST(ClosedLoop, AButtonDrawnOnACurvedSurfaceIsHit) {
    const test::TemporaryFolder folder;
    const std::string calibration = (folder / "projector").string();
    CalibrateOptions calibrate;
    calibrate.config = options_for(std::string(table) + "&hands=0", calibration).config;
    calibrate.pace = Pace::step;
    ASSERT_EQ(calibrate_command(calibrate), ExitStatus::ok);

    const RunOptions options = options_for(std::string(table) + "&hands=1&guided=1", calibration);
    Perception perception(options);
    SimulatedProjector* projector = nullptr;
    Presentation presentation(options, [&]() -> std::unique_ptr<Display> {
        auto made = open_simulated_projector();
        projector = made.get();
        return made;
    });
    Picture before;
    std::optional<Eigen::Vector2f> button_px;
    int lit_before = 0, most_lit = 0;
    for (int frame = 0; frame < 400; ++frame) {
        const std::optional<TableFrame> shown = perception.step();
        ASSERT_TRUE(shown);
        presentation.draw(*shown);
        presentation.show();
        if (frame == 60) {
            ASSERT_EQ(shown->state, "live");
            // Nothing but the menu's button is drawn in the upper half.
            button_px = lit_middle(projector->read_pixels(), 400, &lit_before);
            ASSERT_TRUE(button_px);
            projector->set_aim(std::array{button_px->x(), button_px->y()});
        }
        if (frame <= 60) continue;
        int lit = 0;
        lit_middle(projector->read_pixels(), 400, &lit);
        most_lit = std::max(most_lit, lit);
    }
    EXPECT_GT(most_lit, 3 * lit_before) << "the opened menu is larger than its button and the finger's ring";
}

}  // namespace
}  // namespace touchstone
