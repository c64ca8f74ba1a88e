#include "app/command_line.hpp"

#include <fstream>

#include "tests/support/expect_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

Command parse(std::vector<const char*> words) {
    words.insert(words.begin(), "touchstone");
    return parse_command_line(static_cast<int>(words.size()), words.data());
}

TEST(CommandLine, ComplaintsAreForPeople) {
    expect_error(
        [] {
            (void)parse({"run", "--pase", "live"});
        },
        ExitStatus::usage, testing::HasSubstr("not understood: --pase live; see touchstone --help"));
    for (const char* frames : {"0", "-3", "many", "1e9"})
        expect_error(
            [&] {
                (void)parse({"--frames", frames});
            },
            ExitStatus::usage, testing::HasSubstr(std::string(frames) + " is not a whole number from 1"));
    expect_error(
        [] {
            (void)parse({"calibrate", "--frames", "20"});
        },
        ExitStatus::usage, testing::HasSubstr("not understood: --frames 20"));
}

TEST(CommandLine, NoSubCommandMeansRun) {
    const RunOptions plain = std::get<RunOptions>(parse({"--frames", "7", "--display", "headless"}));
    const RunOptions named = std::get<RunOptions>(parse({"run", "--frames", "7", "--display", "headless"}));
    EXPECT_EQ(plain.frames, 7);
    EXPECT_EQ(named.frames, 7);
    EXPECT_EQ(plain.display, DisplayKind::headless);
    EXPECT_FALSE(std::get<RunOptions>(parse({})).frames.has_value());
    EXPECT_FALSE(std::get<RunOptions>(parse({})).display.has_value());
    EXPECT_EQ(std::get<RunOptions>(parse({"--display", "window"})).display, DisplayKind::window);
    EXPECT_EQ(std::get<RunOptions>(parse({"--display", "projector"})).display, DisplayKind::projector);
}

TEST(CommandLine, EveryOptionOfTheContract) {
    const RunOptions options =
        std::get<RunOptions>(parse({"run", "--sensor", "seq:/data", "--pace", "live", "--scene", "paint",
                                    "--events", "-", "--maps", "m", "--shots", "s"}));
    EXPECT_EQ(options.config.sensor_uri, "seq:/data");
    EXPECT_EQ(options.pace, Pace::live);
    EXPECT_EQ(options.config.display.scene, "paint");
    EXPECT_EQ(options.events_file, "-");
    EXPECT_EQ(options.maps_dir, "m");
    EXPECT_EQ(options.shots_dir, "s");
}

TEST(CommandLine, CalibrateWatchesStripesUnlessTouchesAreAskedFor) {
    const CalibrateOptions plain = std::get<CalibrateOptions>(parse({"calibrate"}));
    EXPECT_EQ(plain.method, CalibrationMethod::graycode);
    EXPECT_FALSE(plain.json_file || plain.display || plain.pace);
    const CalibrateOptions named = std::get<CalibrateOptions>(
        parse({"calibrate", "--sensor", "sim:flat?projector=1", "--method", "touch", "--json", "-",
               "--display", "projector", "--pace", "step"}));
    EXPECT_EQ(named.config.sensor_uri, "sim:flat?projector=1");
    EXPECT_EQ(named.method, CalibrationMethod::touch);
    EXPECT_EQ(named.json_file, "-");
    EXPECT_EQ(named.display, DisplayKind::projector);
    EXPECT_EQ(named.pace, Pace::step);
    expect_error(
        [] {
            parse({"calibrate", "--method", "chessboard"});
        },
        ExitStatus::usage, ::testing::HasSubstr("graycode"));
}

TEST(CommandLine, BenchTakesEveryFrameInOrder) {
    const BenchOptions plain = std::get<BenchOptions>(parse({"bench"}));
    EXPECT_EQ(plain.pace, Pace::step);
    EXPECT_FALSE(plain.moving);
    EXPECT_EQ(plain.frames, 600);
    EXPECT_FALSE(plain.json_file);
    EXPECT_FALSE(plain.display);
    EXPECT_EQ(std::get<BenchOptions>(parse({"bench", "--display", "window"})).display, DisplayKind::window);
    const BenchOptions options = std::get<BenchOptions>(
        parse({"bench", "--moving", "--json", "-", "--frames", "9", "--voxels", "256", "--side", "3"}));
    EXPECT_TRUE(options.moving);
    EXPECT_EQ(options.json_file, "-");
    EXPECT_EQ(options.frames, 9);
    EXPECT_EQ(options.voxels, 256);
    EXPECT_EQ(options.side_m, 3.0f);
}

TEST(CommandLine, CheckReadsItsConfigurationItself) {
    const CheckOptions plain = std::get<CheckOptions>(parse({"check"}));
    EXPECT_FALSE(plain.json);
    EXPECT_EQ(plain.config_file, "");
    const CheckOptions options =
        std::get<CheckOptions>(parse({"check", "--json", "--config", "/nowhere.toml"}));
    EXPECT_TRUE(options.json);
    EXPECT_EQ(options.config_file, "/nowhere.toml");
    expect_error([] { parse({"--frames", "3", "check"}); }, ExitStatus::usage, testing::HasSubstr("check"));
}

TEST(CommandLine, PrintConfigAndHelpAreTextsForStandardOutput) {
    EXPECT_THAT(std::get<PrintedText>(parse({"run", "--print-config"})).text,
                testing::HasSubstr("[scan]\nframes = 20"));
    EXPECT_THAT(std::get<PrintedText>(parse({"--help"})).text, testing::HasSubstr("--sensor"));
    EXPECT_FALSE(std::get<PrintedText>(parse({"--version"})).text.empty());
}

TEST(CommandLine, WhereNothingIsKeptTheFilesOfTheConfigurationAreLeftAlone) {
    const TemporaryFolder folder;
    const std::string file = (folder / "table.toml").string();
    std::ofstream(file)
        << "[scan]\nfile = \"a\"\n[touch]\nbias_file = \"b\"\n[display]\npainting_file = \"c\"\n"
           "[projector]\nfile = \"d\"\n[health]\nfault_dir = \"e\"\n"
           "[objects]\nexport_dir = \"f\"\n[areas]\nfile = \"g\"\n";
    const auto named = [](const RunOptions& options) {
        const Config& config = options.config;
        return std::vector<std::string>{config.scan_file,
                                        config.bias_file,
                                        config.display.painting_file,
                                        config.projector.file,
                                        config.fault_reports.dir,
                                        config.interaction.background.objects.export_dir};
    };
    EXPECT_THAT(named(std::get<RunOptions>(parse({"run", "--config", file.c_str()}))),
                testing::Each(testing::StartsWith(folder.path().string())));
    const RunOptions left = std::get<RunOptions>(parse({"run", "--config", file.c_str(), "--keep-nothing"}));
    EXPECT_THAT(named(left), testing::Each(""));
    EXPECT_TRUE(left.keeps_nothing);
    EXPECT_EQ(left.config.areas_file, (folder / "g").string()) << "they are shown";
}

TEST(CommandLine, ScanNeedsAFileAndTakesTheRest) {
    const ScanOptions plain = std::get<ScanOptions>(parse({"scan", "--scan", "room.scan"}));
    EXPECT_EQ(plain.scan_file, "room.scan");
    EXPECT_EQ(plain.config.sensor_uri, "");
    EXPECT_FALSE(plain.frames || plain.mesh_file || plain.pace);
    EXPECT_TRUE(plain.config.interaction.background.fit_side);
    const ScanOptions whole =
        std::get<ScanOptions>(parse({"scan", "--sensor", "sim:flat", "--frames", "9", "--scan", "a", "--mesh",
                                     "b.ply", "--pace", "step"}));
    EXPECT_EQ(whole.config.sensor_uri, "sim:flat");
    EXPECT_EQ(whole.frames, 9);
    EXPECT_EQ(whole.mesh_file, "b.ply");
    EXPECT_EQ(whole.pace, Pace::step);
}

TEST(CommandLine, TrackHasItsOwnVolume) {
    const TrackOptions plain = std::get<TrackOptions>(parse({"track", "--sensor", "seq:/data"}));
    EXPECT_EQ(plain.config.sensor_uri, "seq:/data");
    EXPECT_EQ(plain.voxels, 512);
    EXPECT_EQ(plain.side_m, 4.8f);
    EXPECT_FALSE(plain.trajectory_file || plain.mesh_file || plain.scan_file || plain.frames || plain.pace);
    const TrackOptions whole = std::get<TrackOptions>(
        parse({"track", "--sensor", "seq:/data", "--trajectory", "t", "--mesh", "m.obj", "--scan", "s",
               "--voxels", "256", "--side", "3", "--frames", "5", "--pace", "live"}));
    EXPECT_EQ(whole.trajectory_file, "t");
    EXPECT_EQ(whole.mesh_file, "m.obj");
    EXPECT_EQ(whole.scan_file, "s");
    EXPECT_EQ(whole.voxels, 256);
    EXPECT_EQ(whole.side_m, 3.0f);
    EXPECT_EQ(whole.frames, 5);
    EXPECT_EQ(whole.pace, Pace::live);
}

TEST(CommandLine, RecordNeedsAFileAndTakesNoVolume) {
    const RecordOptions plain = std::get<RecordOptions>(parse({"record", "table.oni"}));
    EXPECT_EQ(plain.oni_file, "table.oni");
    EXPECT_EQ(plain.config.sensor_uri, "") << "the attached camera";
    EXPECT_FALSE(plain.pace || plain.frames || plain.with_color);
    const RecordOptions whole = std::get<RecordOptions>(
        parse({"record", "--sensor", "sim:flat", "a.oni", "--frames", "9", "--pace", "step", "--color"}));
    EXPECT_EQ(whole.config.sensor_uri, "sim:flat");
    EXPECT_EQ(whole.frames, 9);
    EXPECT_EQ(whole.pace, Pace::step);
    EXPECT_TRUE(whole.with_color);
    for (const auto& words : std::vector<std::vector<const char*>>{{"record"},
                                                                   {"record", ""},
                                                                   {"record", "a.oni", "b.oni"},
                                                                   {"record", "a.oni", "--frames", "0"},
                                                                   {"record", "a.oni", "--voxels", "128"}})
        expect_error([&] { (void)parse(words); }, ExitStatus::usage, testing::HasSubstr("--help"));
}

TEST(CommandLine, VolumeOfTheFixedCamera) {
    const BackgroundConfig voxels =
        std::get<RunOptions>(parse({"run", "--voxels", "128"})).config.interaction.background;
    EXPECT_EQ(voxels.volume.size_vox, 128);
    EXPECT_TRUE(voxels.fit_side);
    const BackgroundConfig side =
        std::get<ScanOptions>(parse({"scan", "--scan", "a", "--side", "2.5"})).config.interaction.background;
    EXPECT_EQ(side.volume.side_m, 2.5f);
    EXPECT_FALSE(side.fit_side);
}

TEST(CommandLine, VolumesThatCannotBeAreUsageErrors) {
    for (const char* voxels : {"0", "63", "100", "1032", "-64", "64.5", "many", "99999999999999999999"}) {
        expect_error(
            [&] {
                (void)parse({"track", "--sensor", "sim:flat", "--voxels", voxels});
            },
            ExitStatus::usage,
            testing::AllOf(testing::HasSubstr("--voxels"), testing::HasSubstr("from 64 to 1024")));
    }
    for (const char* side : {"0", "0.1", "10.1", "-1", "nan", "inf", "wide"}) {
        expect_error(
            [&] {
                (void)parse({"track", "--sensor", "sim:flat", "--side", side});
            },
            ExitStatus::usage,
            testing::AllOf(testing::HasSubstr("--side"), testing::HasSubstr("from 0.2 to 10")));
    }
}

TEST(CommandLine, WhatScanAndTrackCannotDoWithout) {
    expect_error([] { (void)parse({"track"}); }, ExitStatus::usage, testing::HasSubstr("--sensor"));
    expect_error(
        [] {
            (void)parse({"track", "--sensor", ""});
        },
        ExitStatus::usage, testing::HasSubstr("--sensor"));
    expect_error([] { (void)parse({"scan"}); }, ExitStatus::usage, testing::HasSubstr("--scan"));
    expect_error(
        [] {
            (void)parse({"scan", "--scan", ""});
        },
        ExitStatus::usage, testing::HasSubstr("--scan"));
}

TEST(CommandLine, NothingGivenIsLost) {
    expect_error(
        [] {
            (void)parse({"--frames", "3", "scan", "--scan", "a"});
        },
        ExitStatus::usage, testing::HasSubstr("--frames goes behind scan"));
    expect_error(
        [] {
            (void)parse({"scan", "--scan", "a.ply", "--mesh", "a.ply"});
        },
        ExitStatus::usage, testing::HasSubstr("a.ply is named for two results"));
    expect_error(
        [] {
            (void)parse({"scan", "--scan", "a", "--trajectory", "t"});
        },
        ExitStatus::usage, testing::HasSubstr("--trajectory"));
}

TEST(CommandLine, WhatIsNotUnderstoodIsAUsageError) {
    for (const auto& words : std::vector<std::vector<const char*>>{{"--nonsense"},
                                                                   {"run", "--pace", "fast"},
                                                                   {"run", "--frames", "0"},
                                                                   {"run", "--frames", "many"},
                                                                   {"run", "--scene", "nowhere"},
                                                                   {"run", "--display", "wall"},
                                                                   {"dance"}}) {
        expect_error([&] { (void)parse(words); }, ExitStatus::usage, testing::HasSubstr("--help"));
    }
}

}  // namespace
}  // namespace touchstone
