#include "tests/accuracy/baseline_run.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>

#include "tests/accuracy/touch_score.hpp"

namespace touchstone {
namespace {

constexpr Intrinsics k{500.0F, 500.0F, 32.0F, 24.0F, 64, 48, {0, 0}};

TEST(BaselineRun, APixelIsThePointOfTheSurfaceBehindIt) {
    const auto background = baselines::background_of(baselines::DepthPicture(64, 48, 1000));
    const auto point_mm = surface_point_mm(background, k, {42.0, 19.0});
    EXPECT_NEAR(point_mm[0], 20.0, 1e-6);
    EXPECT_NEAR(point_mm[1], -10.0, 1e-6);
    EXPECT_NEAR(point_mm[2], 1000.0, 1e-6);
}

TEST(BaselineRun, WithoutAReadingTheNearestPixelGivesTheDepth) {
    baselines::DepthPicture picture(64, 48, 0);
    picture.at(40, 19) = 800;
    picture.at(45, 19) = 1200;
    const auto near_mm = surface_point_mm(baselines::background_of(picture), k, {42.0, 19.0});
    EXPECT_NEAR(near_mm[2], 800.0, 1e-6);
    EXPECT_NEAR(near_mm[0], 16.0, 1e-6);
    const auto far_mm = surface_point_mm(baselines::background_of(picture), k, {2.0, 19.0});
    EXPECT_EQ(far_mm[2], 0.0) << "38 pixels away";
}

/// The most contacts that each method finds at one of two camera heights: a finger has 3 to 5 pixels across
/// at the one, and the tens of pixels that a blob must have at the other.
class BothHeights {
  public:
    void look(const std::string& scene) {
        auto methods = baselines::published_methods();
        const BaselineRun run = run_baselines(scene, methods);
        for (std::size_t i = 0; i < methods.size(); ++i) {
            int& most = found[methods[i].name];
            most = std::max(most, score_touches(run.truth, run.logs[i]).all.found);
            EXPECT_TRUE(std::all_of(run.logs[i].begin(), run.logs[i].lower_bound(105),
                                    [](const auto& frame) { return frame.second.empty(); }))
                << methods[i].name << " before there are hands";
        }
    }

    std::map<std::string, int> found;
};

/// Two and a half seconds of two hands on exact flat tables: a method that finds nothing there does not do
/// what it was published for.
TEST(BaselineRun, EachMethodFindsTouchesOnATableWithoutNoise) {
    BothHeights both;
    for (const char* height : {"0.7", "1.4"})
        both.look(std::string("flat?hands=2&seed=1&frames=180&empty=3.5&noise=0&human=0&tilt=20&height=") +
                  height);
    EXPECT_EQ(both.found.size(), 7U);
    for (const auto& [name, found] : both.found) EXPECT_GE(found, 1) << name;
}

}  // namespace
}  // namespace touchstone
