#include "platform/output/event_log.hpp"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

TouchReport report_with_a_touch_and_a_hover() {
    return {.frame = 12,
            .time_us = 400'000,
            .state = "live",
            .touches = {{.id = 3,
                         .phase = ReportedPhase::down,
                         .camera_mm = {-10.126, 20.0, 801.5},
                         .surface = {0.25, 0.7512345},
                         .height_mm = 0.4}},
            .hovers = {{.id = 4, .camera_mm = {1.0, 2.0, 800.0}, .surface = {0.5, 0.5}, .height_mm = 21.0}}};
}

TEST(EventLine, IsTheLineOfTheContract) {
    EXPECT_EQ(event_line(report_with_a_touch_and_a_hover()),
              R"({"frame":12,"time_us":400000,"state":"live","touches":[{"id":3,"phase":"down",)"
              R"("camera_mm":[-10.13,20.0,801.5],"surface":[0.25,0.75123],"height_mm":0.4}],)"
              R"("hovers":[{"id":4,"camera_mm":[1.0,2.0,800.0],"surface":[0.5,0.5],"height_mm":21.0}]})");
}

TEST(EventLine, NamesTheAreaOfAFingerThatIsInOne) {
    TouchReport report{1, 2, "live", {}, {}};
    report.touches.resize(2);
    report.touches[1].area = "left";
    EXPECT_EQ(event_line(report).find("\"area\":\"left\""), event_line(report).rfind("\"area\":"));
    EXPECT_NE(event_line(report).find("\"area\":\"left\""), std::string::npos);
}

TEST(EventLine, OfAnEmptyFrameHasEmptyLists) {
    EXPECT_EQ(event_line({.frame = 0, .time_us = 0, .state = "scanning", .touches = {}, .hovers = {}}),
              R"({"frame":0,"time_us":0,"state":"scanning","touches":[],"hovers":[]})");
}

TEST(EventLine, SaysWhereAHeldObjectIs) {
    TouchReport report{.frame = 1, .time_us = 2, .state = "live", .touches = {}, .hovers = {}};
    report.object = {"tracked", "", {-10.126, 20.0, 801.5}, {0.0, 0.6, 0.0, 0.8}};
    const std::string before = R"({"frame":1,"time_us":2,"state":"live","touches":[],"hovers":[],"object":)";
    EXPECT_EQ(
        event_line(report),
        before + R"({"state":"tracked","camera_mm":[-10.13,20.0,801.5],"quaternion":[0.0,0.6,0.0,0.8]}})");
    report.object = {"lost", "only 3 % of the object is seen", {}, {}};
    EXPECT_EQ(event_line(report), before + R"({"state":"lost","reason":"only 3 % of the object is seen"}})");
}

TEST(EventLine, NamesAllPhasesAndHasNoMinusZero) {
    TouchReport report = report_with_a_touch_and_a_hover();
    report.touches[0].phase = ReportedPhase::up;
    report.touches[0].height_mm = -0.001;
    EXPECT_THAT(event_line(report), testing::HasSubstr(R"("phase":"up")"));
    EXPECT_THAT(event_line(report), testing::HasSubstr(R"("height_mm":0.0)"));
    report.touches[0].phase = ReportedPhase::move;
    EXPECT_THAT(event_line(report), testing::HasSubstr(R"("phase":"move")"));
}

TEST(EventLog, WritesOneLineAFrameAtOnce) {
    const std::string path = testing::TempDir() + "event_log_test.jsonl";
    EventLog log(path);
    log.publish(report_with_a_touch_and_a_hover());
    log.publish({.frame = 13, .time_us = 433'333, .state = "live", .touches = {}, .hovers = {}});
    std::ifstream file(path);
    std::vector<int> frames;
    for (std::string line; std::getline(file, line);) frames.push_back(nlohmann::json::parse(line)["frame"]);
    EXPECT_EQ(frames, (std::vector<int>{12, 13}));
    std::remove(path.c_str());
}

TEST(EventLog, WritesToStandardOutputWhenAsked) {
    testing::internal::CaptureStdout();
    {
        EventLog log("-");
        log.publish(report_with_a_touch_and_a_hover());
    }
    EXPECT_EQ(testing::internal::GetCapturedStdout(), event_line(report_with_a_touch_and_a_hover()) + "\n");
}

TEST(EventLog, NamesAFileThatCannotBeOpened) {
    try {
        EventLog log("/nonexistent/events.jsonl");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.status(), ExitStatus::io_error);
        EXPECT_THAT(error.what(), testing::HasSubstr("/nonexistent/events.jsonl"));
    }
}

TEST(EventLog, ReportsAFullDisk) {
    EventLog log("/dev/full");
    try {
        log.publish(report_with_a_touch_and_a_hover());
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.status(), ExitStatus::io_error);
        EXPECT_THAT(error.what(), testing::HasSubstr("No space left"));
    }
}

}  // namespace
}  // namespace touchstone
