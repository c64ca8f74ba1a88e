#include "tests/accuracy/touch_record.hpp"

#include <fstream>
#include <gtest/gtest.h>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

class TouchRecord : public testing::Test {
  protected:
    ~TouchRecord() override { std::filesystem::remove(path_); }
    const std::filesystem::path& write(const std::string& text) {
        std::ofstream(path_) << text;
        return path_;
    }
    ExitStatus status_of(const std::string& text) {
        try {
            read_touch_log(write(text));
        } catch (const Error& error) {
            return error.status();
        }
        return ExitStatus::ok;
    }
    std::filesystem::path path_ = testing::TempDir() + "touch_record_test";
};

TEST_F(TouchRecord, ReadsTheTruthOfTheSimulator) {
    const TouchTruth truth = read_touch_truth(write(
        R"({"fps":30,"frames":2,"tips":[[],[{"hand":0,"finger":1,"gap_mm":0.5,"camera_mm":[1,2,800.5]}]]})"));
    ASSERT_EQ(truth.tips.size(), 2u);
    EXPECT_TRUE(truth.tips[0].empty());
    EXPECT_EQ(truth.tips[1][0].finger, 1);
    EXPECT_DOUBLE_EQ(truth.tips[1][0].camera_mm[2], 800.5);
}

TEST_F(TouchRecord, ReadsTheEventLogWithoutTouchesThatEnd) {
    const TouchLog log = read_touch_log(write(
        R"({"frame":4,"touches":[{"id":3,"phase":"down","camera_mm":[1,2,3],"surface":[0,0]}],"hovers":[]})"
        "\n\n"
        R"({"frame":5,"touches":[{"id":3,"phase":"up","camera_mm":[1,2,3]}],"hovers":[]})"
        "\n"));
    EXPECT_EQ(log.at(4).at(0).id, 3);
    EXPECT_TRUE(log.at(5).empty());
}

TEST_F(TouchRecord, TellsAMissingFileFromABadOne) {
    EXPECT_EQ(status_of("{\"frame\":"), ExitStatus::bad_data);
    EXPECT_EQ(status_of("{\"touches\":[]}"), ExitStatus::bad_data);
    EXPECT_THROW(read_touch_truth(write("[]")), Error);
    try {
        read_touch_log("/nonexistent");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.status(), ExitStatus::no_input);
    }
}

}  // namespace
}  // namespace touchstone
