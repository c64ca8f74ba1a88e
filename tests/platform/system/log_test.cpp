#include "platform/system/log.hpp"

#include <gtest/gtest.h>

namespace touchstone {
namespace {

TEST(Log, WritesOneLineToStandardErrorWithTheLevel) {
    set_log_level(LogLevel::info);
    testing::internal::CaptureStderr();
    log_warning("pool is {} % full", 93);
    const std::string line = testing::internal::GetCapturedStderr();
    EXPECT_NE(line.find("warning"), std::string::npos) << line;
    EXPECT_NE(line.find("pool is 93 % full\n"), std::string::npos) << line;
}

TEST(Log, DropsLinesBelowItsLevel) {
    set_log_level(LogLevel::warning);
    testing::internal::CaptureStderr();
    log_info("not seen");
    log_error("seen");
    const std::string lines = testing::internal::GetCapturedStderr();
    EXPECT_EQ(lines.find("not seen"), std::string::npos) << lines;
    EXPECT_NE(lines.find("seen"), std::string::npos) << lines;
    set_log_level(LogLevel::info);
}

TEST(Log, TakesTextWithBracesAsItIs) {
    testing::internal::CaptureStderr();
    log_line(LogLevel::info, "{\"json\": {}}");
    EXPECT_NE(testing::internal::GetCapturedStderr().find("{\"json\": {}}"), std::string::npos);
}

TEST(Log, ParsesLevels) {
    EXPECT_EQ(parse_log_level("debug"), LogLevel::debug);
    EXPECT_EQ(parse_log_level("error"), LogLevel::error);
    EXPECT_FALSE(parse_log_level("loud").has_value());
}

}  // namespace
}  // namespace touchstone
