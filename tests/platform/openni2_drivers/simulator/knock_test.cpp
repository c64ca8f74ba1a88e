#include "platform/openni2_drivers/simulator/knock.hpp"

#include <cmath>
#include <fmt/core.h>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numbers>

#include "platform/openni2_drivers/simulator/scene.hpp"
#include "platform/openni2_drivers/simulator/simulator_source.hpp"
#include "tests/platform/openni2_drivers/simulator/pose_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using Eigen::Isometry3d;

double degrees_of(const Isometry3d& T) {
    return Eigen::AngleAxisd(T.linear()).angle() * 180.0 / std::numbers::pi;
}

TEST(Knock, ComesAtItsTimeAndFollowsTheSeed) {
    const SimulatorConfig config = parse_simulator_uri("flat?knock_s=2&knock_deg=5&knock_mm=50");
    EXPECT_TRUE(sim::knock(config, 1.99).matrix().isIdentity(0.0));
    const Isometry3d after = sim::knock(config, 2.0);
    EXPECT_NEAR(degrees_of(after), 5.0, 1e-9);
    EXPECT_NEAR(after.translation().norm(), 0.050, 1e-12);
    EXPECT_TRUE(sim::knock(config, 99.0).isApprox(after, 0.0));
    const SimulatorConfig other = parse_simulator_uri("flat?knock_s=2&knock_deg=5&knock_mm=50&seed=2");
    EXPECT_GT((sim::knock(other, 2.0).translation() - after.translation()).norm(), 0.005);
    EXPECT_TRUE(sim::knock(parse_simulator_uri("flat"), 99.0).matrix().isIdentity(0.0)) << "none by itself";
}

TEST(Knock, EverySceneWithAFixedCameraTakesIt) {
    const TemporaryFolder folder;
    const std::string keys =
        "&frames=5&knock_s=0.1&knock_deg=3&knock_mm=20&noise=0&poses=" + (folder / "p.txt").string();
    for (const std::string scene :
         {"cluttered?hands=0", "room?motion=still", "wall?seed=2", "object?seed=3"}) {
        const std::vector<SourceFrame> frames = play(scene + keys);
        const std::vector<TimedPose> poses = read_poses(folder / "p.txt");
        ASSERT_EQ(poses.size(), 5U) << scene;
        // The object moves by itself in the meantime, less than half a millimetre a frame at the start.
        const bool object = scene.starts_with("object");
        const Isometry3d before = poses[1].T_s_c.inverse() * poses[2].T_s_c;
        const Isometry3d step = poses[2].T_s_c.inverse() * poses[3].T_s_c;
        EXPECT_LT(before.translation().norm(), object ? 0.002 : 1e-9) << scene;
        EXPECT_NEAR(step.translation().norm(), 0.020, object ? 0.004 : 1e-6) << scene;
        EXPECT_NEAR(degrees_of(step), 3.0, object ? 0.4 : 1e-3) << scene;
        EXPECT_LT((poses[3].T_s_c.inverse() * poses[4].T_s_c).translation().norm(), object ? 0.002 : 1e-9)
            << scene;
        EXPECT_NE(frames[2].depth_mm, frames[3].depth_mm) << scene;
    }
}

TEST(Knock, ATableIsSeenFromWhereTheCameraIsThen) {
    const TemporaryFolder folder;
    const std::vector<SourceFrame> frames =
        play("flat?hands=0&frames=4&noise=0&knock_s=0.1&knock_deg=4&knock_mm=40&poses=" +
             (folder / "p.txt").string());
    const std::vector<TimedPose> poses = read_poses(folder / "p.txt");
    double missed_m = 0.0;
    for (const std::size_t frame : {0U, 3U})
        for (std::size_t i = 0; i < 640 * 480; i += 101) {
            const double z_m = 1e-3 * frames[frame].depth_mm[i];
            const Eigen::Vector3d p_c(z_m * (static_cast<double>(i % 640) - 319.5) / 575.8,
                                      z_m * (static_cast<double>(i / 640) - 239.5) / 575.8, z_m);
            // The table is z = 0; half a millimetre of rounding along the ray.
            EXPECT_NEAR((poses[frame].T_s_c * p_c).z(), 0.0, 0.0007);
            if (frame == 3) missed_m = std::max(missed_m, std::abs((poses[0].T_s_c * p_c).z()));
        }
    EXPECT_GT(missed_m, 0.02) << "from where the camera was, it is another table";
}

TEST(Knock, ColoursAndHandsAreSeenFromThereToo) {
    const std::string uri = "flat?hands=1&empty=0&seed=8&frames=40&noise=0";
    const TemporaryFolder folder;
    const std::vector<SourceFrame> calm = play(uri, true);
    const std::vector<SourceFrame> knocked =
        play(uri + "&knock_s=1&knock_deg=4&knock_mm=40&poses=" + (folder / "p.txt").string(), true);
    EXPECT_EQ(calm[29].depth_mm, knocked[29].depth_mm);
    EXPECT_EQ(calm[29].color_rgb, knocked[29].color_rgb);
    int other_bytes = 0;
    for (std::size_t i = 0; i < calm[30].color_rgb.size(); ++i)
        other_bytes += calm[30].color_rgb[i] != knocked[30].color_rgb[i];
    EXPECT_GT(other_bytes, 300000) << "the grain of the wood is elsewhere";
    // The highest point of the hand is where it was: 1 mm of rounding, and of other pixels.
    const std::vector<TimedPose> poses = read_poses(folder / "p.txt");
    const auto highest = [](const SourceFrame& frame, const Isometry3d& T_s_c) {
        Eigen::Vector3d top = Eigen::Vector3d::Zero();
        for (std::size_t i = 0; i < frame.depth_mm.size(); ++i) {
            const double z_m = 1e-3 * frame.depth_mm[i];
            const Eigen::Vector3d p_s =
                T_s_c * Eigen::Vector3d(z_m * (static_cast<double>(i % 640) - 319.5) / 575.8,
                                        z_m * (static_cast<double>(i / 640) - 239.5) / 575.8, z_m);
            if (p_s.z() > top.z() && p_s.head<2>().norm() < 0.25) top = p_s;
        }
        return top;
    };
    const Eigen::Vector3d before = highest(calm[39], poses[0].T_s_c);
    const Eigen::Vector3d after = highest(knocked[39], poses[39].T_s_c);
    EXPECT_GT(before.z(), 0.02);
    EXPECT_NEAR(before.z(), after.z(), 0.002);
}

TEST(Knock, TheHandsTruthIsInTheCameraFrameOfTheTime) {
    const TemporaryFolder folder;
    play("flat?hands=1&frames=240&noise=0&empty=0&seed=8&knock_s=2&knock_deg=5&knock_mm=50&poses=" +
         (folder / "p.txt").string() + "&truth=" + (folder / "t.json").string());
    const std::vector<TimedPose> poses = read_poses(folder / "p.txt");
    std::ifstream file(folder / "t.json");
    const nlohmann::json tips = nlohmann::json::parse(file)["tips"];
    ASSERT_EQ(tips.size(), poses.size());
    int after = 0;
    for (std::size_t frame = 0; frame < tips.size(); ++frame)
        for (const nlohmann::json& tip : tips[frame]) {
            const Eigen::Vector3d foot_mm(tip["camera_mm"][0], tip["camera_mm"][1], tip["camera_mm"][2]);
            EXPECT_NEAR((poses[frame].T_s_c * (1e-3 * foot_mm)).z(), 0.0, 2e-5) << frame;
            after += frame >= 60;
        }
    EXPECT_GT(after, 30);
}

}  // namespace
}  // namespace touchstone
