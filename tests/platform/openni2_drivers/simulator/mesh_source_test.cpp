#include "platform/openni2_drivers/simulator/mesh_source.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "platform/openni2_drivers/simulator/mesh_distance.hpp"
#include "tests/platform/openni2_drivers/simulator/pose_file.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;

/// The largest distance in metres of a frame's points from the truth, at every 37th pixel.
double worst_error_m(const SourceFrame& frame, const Eigen::Isometry3d& T_s_c,
                     const sim::MeshDistance& truth) {
    double worst_m = 0.0;
    for (std::size_t i = 0; i < frame.depth_mm.size(); i += 37) {
        if (frame.depth_mm[i] == 0) continue;
        const double z_m = 1e-3 * frame.depth_mm[i];
        const Eigen::Vector3d p_c(z_m * (static_cast<double>(i % 640) - 319.5) / 575.8,
                                  z_m * (static_cast<double>(i / 640) - 239.5) / 575.8, z_m);
        worst_m = std::max(worst_m, truth.distance_m(T_s_c * p_c));
    }
    return worst_m;
}

TEST(MeshSource, DepthPosesAndTruthAgree) {
    const TemporaryFolder folder;
    for (const std::string scene : {"room?motion=sweep", "room?motion=rpy", "wall?motion=slide"}) {
        const std::string uri = scene + "&seed=3&noise=0&frames=40&poses=" + (folder / "poses.txt").string();
        const std::vector<SourceFrame> frames = play(uri);
        const std::vector<TimedPose> poses = read_poses(folder / "poses.txt");
        ASSERT_EQ(poses.size(), 40U);
        EXPECT_NEAR(poses[38].time_s, 38.0 / 30.0, 1e-8);
        EXPECT_FALSE(poses[39].T_s_c.isApprox(poses[0].T_s_c, 1e-3));
        const sim::MeshDistance truth(truth_mesh(parse_simulator_uri(uri)));
        for (const std::size_t i : {0U, 17U, 39U}) {
            // Half a millimetre of rounding, along a ray up to 1.2 times as long as its z.
            EXPECT_LT(worst_error_m(frames[i], poses[i].T_s_c, truth), 0.0007);
            EXPECT_GT(worst_error_m(frames[i], poses[i].T_s_c * Eigen::Translation3d(0.0, 0.0, 0.002), truth),
                      0.0015);
        }
    }
}

TEST(MeshSource, PosesAreWholeAfterEveryFrame) {
    const TemporaryFolder folder;
    const auto source = open_simulator("wall?motion=slide&poses=" + (folder / "poses.txt").string());
    SourceFrame frame;
    for (std::size_t i = 1; i < 4; ++i) {
        source->next(frame);
        EXPECT_EQ(read_poses(folder / "poses.txt").size(), i);
    }
}

TEST(MeshSource, TheSeedDecidesEveryPixel) {
    const std::string uri = "room?motion=sweep&frames=3&seed=";
    const std::vector<SourceFrame> one = play(uri + "5", true);
    const std::vector<SourceFrame> same = play(uri + "5", true);
    const std::vector<SourceFrame> other = play(uri + "6");
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(one[i].depth_mm, same[i].depth_mm);
        EXPECT_EQ(one[i].color_rgb, same[i].color_rgb);
    }
    EXPECT_NE(one[2].depth_mm, other[2].depth_mm);
    EXPECT_EQ(one[2].color_rgb.size(), 3U * 640U * 480U);
    EXPECT_TRUE(other[2].color_rgb.empty());
    EXPECT_EQ(one[2].timestamp_us, 66667U);
}

TEST(MeshSource, NoiseIsTheSensorsAndCanBeLeftOut) {
    const std::vector<SourceFrame> exact = play("wall?frames=1&noise=0");
    const std::vector<SourceFrame> drifting = play("wall?frames=1&noise=0&drift=1");
    const std::vector<SourceFrame> noisy = play("wall?frames=1");
    double squares = 0.0;
    int seen = 0;
    for (std::size_t i = 0; i < noisy[0].depth_mm.size(); ++i) {
        EXPECT_EQ(exact[0].depth_mm[i], 1200);
        EXPECT_EQ(drifting[0].depth_mm[i], 1200) << "the sensor starts calibrated";
        if (noisy[0].depth_mm[i] == 0) continue;
        squares += std::pow(noisy[0].depth_mm[i] - 1200.0, 2.0);
        ++seen;
    }
    EXPECT_GT(seen, 295000);
    EXPECT_NEAR(std::sqrt(squares / seen), 1.35 * 1.44, 0.3) << "grows with the square of 1.2 m";
}

TEST(MeshSource, RefusesWhatItCannotDo) {
    expect_error([] { open_simulator("room?poses=/nowhere/at/all.txt"); }, ExitStatus::io_error,
                 HasSubstr("/nowhere/at/all.txt"));
    expect_error([] { truth_mesh(parse_simulator_uri("bowl")); }, ExitStatus::usage,
                 HasSubstr("no triangles"));
}

}  // namespace
}  // namespace touchstone
