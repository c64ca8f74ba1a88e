#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/scan_file.hpp"
#include "platform/image/png_file.hpp"
#include "tests/accuracy/path_score.hpp"
#include "tests/support/run_program.hpp"

namespace touchstone {
namespace {

using test::ProgramResult;
using test::run_program;
using testing::HasSubstr;

class Track : public testing::Test {
  protected:
    static ProgramResult track(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {TOUCHSTONE_PROGRAM, "track", "--pace", "step"});
        return run_program(std::move(arguments));
    }
    std::string file(const std::string& name) const { return (folder_ / name).string(); }
    std::size_t files() const {
        const std::filesystem::directory_iterator all(folder_.path());
        return static_cast<std::size_t>(std::distance(begin(all), end(all)));
    }

    TemporaryFolder folder_;
};

// 40 frames of a hand-held camera: 30 cm on its way. The bar over 500 frames is 8 mm; without the drift of
// column bands a tenth of that was measured.
TEST_F(Track, PathMeshAndScanOfASimulatedRoom) {
    const ProgramResult result =
        track({"--sensor", "sim:room?motion=sweep&frames=40&seed=3&drift=0&poses=" + file("poses"), "--side",
               "3", "--voxels", "256", "--trajectory", file("path.txt"), "--mesh", file("room.ply"), "--scan",
               file("room.scan")});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("40 frames: 40 fused, 0 lost"));
    const PathScore score = score_path(read_trajectory(file("path.txt")), read_trajectory(file("poses")));
    EXPECT_EQ(score.matched, 40u);
    EXPECT_LT(score.ate_rmse_mm, 2.0);
    EXPECT_LT(score.drift_mm, 6.0);
    EXPECT_GT(std::filesystem::file_size(file("room.ply")), 100'000u);
    const SavedScan scan = load_scan(file("room.scan"));
    EXPECT_EQ(scan.volume.config.size_vox, 256);
    EXPECT_FALSE(scan.volume.color_bricks.empty());
    EXPECT_FALSE(scan.keyframes.empty());
}

TEST_F(Track, FramesEndTheRun) {
    const ProgramResult result =
        track({"--sensor", "sim:room?motion=orbit&seed=3", "--frames", "3", "--voxels", "64"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("3 frames"));
}

TEST_F(Track, MeshOfAnUnknownKindIsRefusedBeforeWorkBegins) {
    const ProgramResult result = track({"--sensor", "sim:room", "--mesh", file("room.dae")});
    EXPECT_EQ(result.status, 64);
    EXPECT_THAT(result.err, HasSubstr(".ply"));
    EXPECT_EQ(files(), 0u);
}

TEST_F(Track, TargetsThatCannotBeWrittenAreFoundBeforeWorkBegins) {
    const ProgramResult result =
        track({"--sensor", "sim:room", "--trajectory", file("no/such/folder/path.txt")});
    EXPECT_EQ(result.status, 74);
    EXPECT_THAT(result.err, HasSubstr("no/such/folder"));
}

TEST_F(Track, PicturesWithoutDepthAreBadData) {
    for (int i = 0; i < 3; ++i)
        write_png(folder_ / ("frame-00000" + std::to_string(i) + ".depth.png"),
                  Image16{160, 120, std::vector<std::uint16_t>(160 * 120, 0)});
    const ProgramResult result =
        track({"--sensor", "seq:" + folder_.path().string(), "--scan", file("x.scan")});
    EXPECT_EQ(result.status, 65) << result.err;
    EXPECT_THAT(result.err, HasSubstr("shows nothing"));
    EXPECT_FALSE(std::filesystem::exists(file("x.scan")));
}

}  // namespace
}  // namespace touchstone
