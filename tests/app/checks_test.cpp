#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/check_report.hpp"
#include "app/configuration_checks.hpp"
#include "app/machine_checks.hpp"
#include "app/sensor_checks.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

UsbDepthCamera kinect(UsbCameraState state) {
    UsbDepthCamera camera{"Kinect v1", state, {}, {}};
    camera.device.bus = 1;
    camera.device.address = 7;
    camera.device.ports = {2, 3};
    return camera;
}

CheckLine line_about(const std::vector<CheckLine>& lines, const std::string& subject) {
    for (const CheckLine& line : lines)
        if (line.subject == subject) return line;
    ADD_FAILURE() << "no line about " << subject;
    return {};
}

TEST(CheckReport, WorstLineDecides) {
    const CheckLine fine{"sensor", CheckStatus::ok, "a Kinect", {}};
    const CheckLine so_so{"disk", CheckStatus::warn, "90 MB free", "make room"};
    const CheckLine broken{"drawing", CheckStatus::fail, "no EGL", "install it"};
    EXPECT_EQ(check_exit_status({fine}), ExitStatus::ok);
    EXPECT_EQ(check_exit_status({fine, so_so}), ExitStatus::ok);
    EXPECT_EQ(check_exit_status({fine, broken, so_so}), ExitStatus::unavailable);
    const CheckLine wrong{"configuration", CheckStatus::fail, "unknown key", "mend it"};
    EXPECT_EQ(check_exit_status({fine, wrong, so_so}), ExitStatus::configuration);
    EXPECT_EQ(check_exit_status({wrong, broken}), ExitStatus::unavailable);
    EXPECT_THAT(check_text({fine}), HasSubstr("\nReady.\n"));
    EXPECT_THAT(check_text({fine, so_so}), HasSubstr("Ready, with 1 warning"));
    const std::string page = check_text({fine, broken, so_so});
    EXPECT_THAT(page, HasSubstr("Not ready: 1 failure(s), 1 warning(s)"));
    EXPECT_THAT(page, HasSubstr("fail  drawing        no EGL\n"));
    EXPECT_THAT(page, HasSubstr("-> install it"));
}

TEST(CheckReport, JsonHasTheSame) {
    const auto json =
        nlohmann::json::parse(check_json({{"disk", CheckStatus::warn, "90 \"MB\"", "make room"}}));
    EXPECT_EQ(json["status"], "warn");
    EXPECT_EQ(json["checks"].size(), 1U);
    EXPECT_EQ(json["checks"][0]["subject"], "disk");
    EXPECT_EQ(json["checks"][0]["status"], "warn");
    EXPECT_EQ(json["checks"][0]["finding"], "90 \"MB\"");
    EXPECT_EQ(json["checks"][0]["advice"], "make room");
}

TEST(SensorChecks, NothingPluggedIn) {
    const auto lines = usb_lines({});
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0].status, CheckStatus::fail);
    EXPECT_THAT(lines[0].advice, HasSubstr("sim:"));
}

TEST(SensorChecks, AReadyKinectHasNothingToDo) {
    for (const CheckLine& line : usb_lines(std::vector{kinect(UsbCameraState::ready)})) {
        EXPECT_EQ(line.status, CheckStatus::ok) << line.subject;
        EXPECT_EQ(line.advice, "") << line.subject;
    }
}

TEST(SensorChecks, PowerPermissionSleepAndHub) {
    const auto dark = usb_lines(std::vector{kinect(UsbCameraState::no_power)});
    EXPECT_EQ(line_about(dark, "power").status, CheckStatus::fail);
    EXPECT_THAT(line_about(dark, "power").advice, HasSubstr("power supply"));
    const auto closed = usb_lines(std::vector{kinect(UsbCameraState::no_permission)});
    EXPECT_EQ(line_about(closed, "permission").status, CheckStatus::fail);
    EXPECT_THAT(line_about(closed, "permission").finding, HasSubstr("/dev/bus/usb/001/007"));
    EXPECT_THAT(line_about(closed, "permission").advice, HasSubstr("udevadm"));
    UsbDepthCamera tired = kinect(UsbCameraState::ready);
    tired.device.autosuspend = true;
    tired.sharing.push_back({0x046d, 0x0825, 1, 9, {1, 2}, false, 480, true, false});
    const auto lines = usb_lines(std::vector{tired});
    EXPECT_EQ(line_about(lines, "USB sleep").status, CheckStatus::warn);
    EXPECT_EQ(line_about(lines, "bandwidth").status, CheckStatus::warn);
    EXPECT_THAT(line_about(lines, "bandwidth").finding, HasSubstr("046d:0825 at 1-1.2"));
}

TEST(SensorChecks, ACameraThatNoDriverTook) {
    const std::vector ready{kinect(UsbCameraState::ready)}, dark{kinect(UsbCameraState::no_power)};
    const OpenniState silent{{"PS1080"}, ""};
    EXPECT_EQ(driver_line(silent, ready).status, CheckStatus::fail);
    EXPECT_EQ(driver_line(silent, dark).status, CheckStatus::ok) << "that is the power's fault";
    EXPECT_EQ(driver_line({{"PS1080"}, "kinect:0"}, ready).status, CheckStatus::ok);
    EXPECT_EQ(driver_line({{}, ""}, ready).status, CheckStatus::fail);
}

TEST(MachineChecks, SpeedClasses) {
    EXPECT_EQ(speed_line(12).status, CheckStatus::ok);
    EXPECT_THAT(speed_line(12).finding, HasSubstr("fast"));
    EXPECT_THAT(speed_line(30).finding, HasSubstr("keeps 30 Hz"));
    EXPECT_EQ(speed_line(50).status, CheckStatus::warn);
    EXPECT_EQ(speed_line(90).status, CheckStatus::fail);
}

TEST(MachineChecks, ConfigurationIsAFinding) {
    const TemporaryFolder folder;
    std::ofstream(folder / "good.toml") << "[scan]\nframes = 22\n";
    std::ofstream(folder / "bad.toml") << "[scan]\nframes = -1\n";
    Config config;
    EXPECT_EQ(check_configuration("", config).status, CheckStatus::ok);
    EXPECT_EQ(check_configuration((folder / "good.toml").string(), config).status, CheckStatus::ok);
    EXPECT_EQ(config.interaction.scan_frames, 22);
    const CheckLine bad = check_configuration((folder / "bad.toml").string(), config);
    EXPECT_EQ(bad.status, CheckStatus::fail);
    EXPECT_THAT(bad.finding, HasSubstr("bad.toml"));
    EXPECT_EQ(check_configuration("/nowhere.toml", config).status, CheckStatus::fail);
}

TEST(ConfigurationChecks, WhatIsNamedAndNotThereIsSaid) {
    const TemporaryFolder folder;
    Config config;
    EXPECT_TRUE(check_named_files(config).empty());
    std::ofstream(folder / "a.png") << "looked at when it is shown";
    config.display.photos = folder.path().string();
    config.scan_file = (folder / "table.scan").string();
    config.fault_reports.dir = (folder / "made/when/needed").string();
    EXPECT_TRUE(check_named_files(config).empty());
    EXPECT_FALSE(std::filesystem::exists(config.scan_file)) << "only looked at";
    config.display.photos = "/nowhere/photos";
    config.display.model = "/nowhere/ball.obj";
    config.scan_file = "/nowhere/table.scan";
    config.object_file = "/nowhere/cup.scan";
    std::ofstream(folder / "file") << "no folder";
    config.fault_reports.dir = (folder / "file/faults").string();
    config.areas_file = (folder / "areas.toml").string();
    std::ofstream(config.areas_file) << "area = 3\n";
    const std::vector<CheckLine> lines = check_named_files(config);
    std::string all;
    for (const CheckLine& line : lines) {
        EXPECT_EQ(line.status, CheckStatus::fail);
        EXPECT_FALSE(line.advice.empty());
        all += line.finding + '\n';
    }
    EXPECT_EQ(lines.size(), 6U) << all;
    EXPECT_THAT(all, AllOf(HasSubstr("display.photos: no folder /nowhere/photos"),
                           HasSubstr("display.model: no mesh file /nowhere/ball.obj"),
                           HasSubstr("scan.file: cannot write /nowhere/table.scan"),
                           HasSubstr("objects.model: no file /nowhere/cup.scan"), HasSubstr("areas.toml:1: "),
                           HasSubstr("health.fault_dir: no folder")));
}

TEST(ConfigurationChecks, WhatTheTableDoesWithoutIsAWarning) {
    const TemporaryFolder folder;
    Config config;
    config.display.photos = folder.path().string();
    config.areas_file = (folder / "areas.toml").string();
    const std::vector<CheckLine> lines = check_named_files(config);
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_EQ(lines[0].status, CheckStatus::warn);
    EXPECT_THAT(lines[0].finding, HasSubstr("display.photos: no pictures in " + folder.path().string()));
    EXPECT_EQ(lines[1].status, CheckStatus::warn);
    EXPECT_THAT(lines[1].finding, HasSubstr("areas.file: no file " + config.areas_file));
}

TEST(ConfigurationChecks, TheExampleIsRight) {
    const TemporaryFolder folder;
    for (const char* name : {"table.toml", "areas.toml"})
        std::filesystem::copy(std::filesystem::path(TOUCHSTONE_SOURCE_DIR) / "examples/table" / name,
                              folder / name);
    Config config;
    EXPECT_EQ(check_configuration((folder / "table.toml").string(), config).status, CheckStatus::ok);
    EXPECT_EQ(config.areas_file, (folder / "areas.toml").string());
    EXPECT_EQ(config.sensor_uri, "sim:curved?hands=2");
    for (const CheckLine& line : check_named_files(config)) ADD_FAILURE() << line.finding;
}

TEST(ConfigurationChecks, AnAreaWithASceneThatIsNotThereFails) {
    const TemporaryFolder folder;
    Config config;
    config.areas_file = (folder / "areas.toml").string();
    for (const char* scene : {"paint", "pant"}) {
        std::ofstream(config.areas_file) << "[[area]]\nname = \"a\"\nscene = \"" << scene
                                         << "\"\ncorners_mm = [[0, 0], [100, 0], [100, 100]]\n";
        const std::vector<CheckLine> lines = check_named_files(config);
        std::string all;
        for (const CheckLine& line : lines) all += line.finding;
        EXPECT_EQ(all, scene == std::string("paint")
                           ? ""
                           : "areas.file: " + config.areas_file +
                                 ": area a: there is no scene pant here; there are paint, particles, mirror, "
                                 "photos, inspect, attract");
    }
}

TEST(ConfigurationChecks, ANamedSourceStandsForTheCamera) {
    Config config;
    EXPECT_TRUE(check_named_source(config).empty());
    config.sensor_uri = "sim:curved?hands=2";
    ASSERT_EQ(check_named_source(config).size(), 1U);
    EXPECT_EQ(check_named_source(config)[0].status, CheckStatus::ok);
    EXPECT_THAT(check_named_source(config)[0].finding, HasSubstr("gives 640x480 at 30 Hz"));
    for (const char* bad : {"sim:curvy", "/nowhere/table.oni"}) {
        config.sensor_uri = bad;
        ASSERT_EQ(check_named_source(config).size(), 1U);
        EXPECT_EQ(check_named_source(config)[0].status, CheckStatus::fail);
        EXPECT_THAT(check_named_source(config)[0].finding, HasSubstr(bad));
    }
}

TEST(MachineChecks, OutputsWithTheirModesALineEach) {
    ASSERT_EQ(output_lines({}).size(), 1U);
    EXPECT_EQ(output_lines({})[0].status, CheckStatus::warn);
    const std::vector<Output> two{{"eDP-1", {{1920, 1200}, 60}, {}},
                                  {"HDMI-A-1 EPSON PJ", {{1280, 800}, 60}, {{{1024, 768}, 75}}}};
    const std::vector<CheckLine> lines = output_lines(two);
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_EQ(lines[1].status, CheckStatus::ok);
    EXPECT_EQ(lines[1].finding, "HDMI-A-1 EPSON PJ (1280x800@60; 1024x768@75)");
}

TEST(MachineChecks, UinputAndService) {
    const TemporaryFolder root;
    EXPECT_EQ(check_uinput(root / "uinput").status, CheckStatus::fail);
    EXPECT_THAT(check_uinput(root / "uinput").advice, HasSubstr("modprobe"));
    std::ofstream(root / "uinput") << "";
    EXPECT_EQ(check_uinput(root / "uinput").status, CheckStatus::ok);
    EXPECT_EQ(check_service(root.path()).status, CheckStatus::warn);
    const auto units = root / "lib/systemd/system",
               wanted = root / "etc/systemd/system/multi-user.target.wants";
    std::filesystem::create_directories(units);
    std::ofstream(units / "touchstone.service") << "[Unit]\n";
    EXPECT_THAT(check_service(root.path()).advice, HasSubstr("systemctl enable"));
    std::filesystem::create_directories(wanted);
    std::filesystem::create_symlink("/lib/systemd/system/touchstone.service", wanted / "touchstone.service");
    EXPECT_EQ(check_service(root.path()).status, CheckStatus::ok);
}

TEST(MachineChecks, DiskOfAFolderThatIsNotThereYet) {
    const CheckLine line = check_disk("/tmp/not/made/yet");
    EXPECT_THAT(line.finding, HasSubstr("MB free at /tmp"));
    EXPECT_THAT(line.finding, Not(HasSubstr("not/made")));
    const CheckLine full = check_disk("/proc/touchstone");
    EXPECT_EQ(full.status, CheckStatus::fail) << full.finding;
}

}  // namespace
}  // namespace touchstone
