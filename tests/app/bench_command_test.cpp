#include "app/bench_command.hpp"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.hpp"

namespace touchstone {
namespace {

using nlohmann::json;
using test::ProgramResult;
using test::run_program;
using testing::HasSubstr;

ProgramResult bench(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {TOUCHSTONE_PROGRAM, "bench"});
    return run_program(std::move(arguments));
}

TEST(BenchResult, IsTheJsonOfTheContractAndATable) {
    BenchResult result;
    result.device = "a device";
    result.frame = {"frame", 8.5, 16.25, 300};
    result.stages.push_back({"raycast", 1.5, 2.5, 299});
    result.peak_rss_mb = 123.5;
    result.volume_mb = 20.25;
    EXPECT_EQ(json::parse(bench_json(result)),
              json::parse(R"({"device":"a device","frames":300,"frame_ms":{"median":8.5,"p99":16.25},
                  "stages":{"raycast":{"median_ms":1.5,"p99_ms":2.5}},"peak_rss_mb":123.5,"volume_mb":20.25})"));
    result.touch_to_photon = {"touch to photon", 18.5, 24.0, 300};
    EXPECT_EQ(json::parse(bench_json(result))["touch_to_photon_ms"],
              json::parse(R"({"median":18.5,"p99":24})"));
    const std::string table = bench_table(result);
    for (const char* part : {"a device", "raycast", "1.50", "300 of them", "16.25", "volume 20.2 MB",
                             "touch to photon                        18.50"})
        EXPECT_THAT(table, HasSubstr(part));
}

/// Six frames of scan come before the five that are measured; the figures of the parts add up to the whole's.
TEST(Bench, MeasuresLiveFramesOfTheTable) {
    const TemporaryFolder folder;
    std::ofstream(folder / "quick.toml") << "[scan]\nframes = 6\n";
    const std::string file = (folder / "bench.json").string();
    const ProgramResult result =
        bench({"--sensor", "sim:flat?hands=1&empty=0.2&seed=2", "--voxels", "128", "--frames", "5",
               "--config", (folder / "quick.toml").string(), "--json", file});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("frame (5 of them)"));
    std::ifstream stream(file);
    const json figures = json::parse(stream);
    EXPECT_EQ(figures["frames"], 5);
    EXPECT_FALSE(figures["stages"].contains("background scan"));
    double sum_ms = 0.0;
    for (const json& stage : figures["stages"]) sum_ms += stage["median_ms"].get<double>();
    EXPECT_GT(sum_ms, 0.5 * figures["frame_ms"]["median"].get<double>());
    EXPECT_GT(figures["peak_rss_mb"], 20.0);
    EXPECT_GT(figures["volume_mb"], 0.5);
}

TEST(Bench, MeasuresThePicturesOfItsFramesToo) {
    const TemporaryFolder folder;
    std::ofstream(folder / "quick.toml") << "[scan]\nframes = 6\n";
    const ProgramResult result =
        bench({"--sensor", "sim:flat?hands=1&empty=0.2&seed=2", "--voxels", "64", "--frames", "3",
               "--display", "headless", "--config", (folder / "quick.toml").string(), "--json", "-"});
    ASSERT_EQ(result.status, 0) << result.err;
    const json figures = json::parse(result.out);
    EXPECT_GT(figures["touch_to_photon_ms"]["median"], 0.0);
    EXPECT_GE(figures["touch_to_photon_ms"]["p99"], figures["touch_to_photon_ms"]["median"]);
}

TEST(Bench, AMovingCamerasPicturesAreNone) {
    const ProgramResult result = bench({"--moving", "--display", "headless", "--sensor", "sim:room"});
    EXPECT_EQ(result.status, 64);
    EXPECT_THAT(result.err, HasSubstr("--moving excludes --display"));
}

TEST(Bench, MeasuresAMovingCamera) {
    const ProgramResult result = bench({"--moving", "--sensor", "sim:room?motion=sweep&seed=3", "--voxels",
                                        "64", "--side", "3", "--frames", "4", "--json", "-"});
    ASSERT_EQ(result.status, 0) << result.err;
    const json figures = json::parse(result.out);
    EXPECT_EQ(figures["frames"], 4);
    EXPECT_TRUE(figures["stages"].contains("camera tracking")) << result.out;
}

TEST(Bench, ASourceThatEndsBeforeItIsLiveIsSaid) {
    const ProgramResult result = bench({"--sensor", "sim:flat?frames=3", "--voxels", "64"});
    EXPECT_EQ(result.status, 65);
    EXPECT_THAT(result.err, HasSubstr("ends before anything is live"));
}

TEST(Bench, AFileThatCannotBeWrittenIsSaidBeforeWorkBegins) {
    const ProgramResult result = bench({"--sensor", "sim:flat", "--json", "/nowhere/bench.json"});
    EXPECT_EQ(result.status, 74);
    EXPECT_THAT(result.err, HasSubstr("/nowhere/bench.json"));
}

}  // namespace
}  // namespace touchstone
