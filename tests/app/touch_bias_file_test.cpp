#include "app/touch_bias_file.hpp"

#include <fstream>
#include <gtest/gtest.h>

#include "platform/system/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

class TouchBiasFile : public testing::Test {
  protected:
    ExitStatus status_of(const std::string& content) {
        std::ofstream(path_) << content;
        try {
            (void)load_touch_bias(path_);
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(path_.string()), std::string::npos) << error.what();
            return error.status();
        }
        return ExitStatus::ok;
    }
    TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "touch.bias";
};

TEST_F(TouchBiasFile, WhatIsWrittenIsRead) {
    TouchBiasFit fit;
    fit.bias = {0.00312f, -0.00071f};
    save_touch_bias(path_, fit);
    const TouchBias bias = load_touch_bias(path_);
    EXPECT_NEAR(bias.along_m, 0.00312f, 1e-6f);
    EXPECT_NEAR(bias.across_m, -0.00071f, 1e-6f);
}

TEST_F(TouchBiasFile, OthersAreNamed) {
    EXPECT_EQ(status_of(""), ExitStatus::bad_data);
    EXPECT_EQ(status_of("{"), ExitStatus::bad_data);
    EXPECT_EQ(status_of("[]"), ExitStatus::bad_data);
    EXPECT_EQ(status_of(R"({"along_mm": 1})"), ExitStatus::bad_data);
    EXPECT_EQ(status_of(R"({"along_mm": "1", "across_mm": 0})"), ExitStatus::bad_data);
    EXPECT_EQ(status_of(R"({"along_mm": 1e300, "across_mm": 0})"), ExitStatus::bad_data);
    EXPECT_EQ(status_of(R"({"along_mm": 1, "across_mm": 0})"), ExitStatus::ok);
    EXPECT_THROW((void)load_touch_bias(folder_ / "none"), Error);
}

}  // namespace
}  // namespace touchstone
