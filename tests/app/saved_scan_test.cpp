#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "pipeline/scan_file.hpp"
#include "tests/support/run_program.hpp"

namespace touchstone {
namespace {

using test::ProgramResult;
using test::run_program;
using testing::HasSubstr;

class SavedScanTest : public testing::Test {
  protected:
    ProgramResult play(const std::string& sensor) {
        std::ofstream(folder_ / "table.toml")
            << "[display]\nwidth_px = 160\nheight_px = 120\n[tuio]\nenabled = false\n"
            << "[volume]\nsize_vox = 256\n[scan]\nfile = \"" << scan_.string() << "\"\n";
        return run_program({TOUCHSTONE_PROGRAM, "run", "--sensor", sensor, "--pace", "step", "--display",
                            "headless", "--config", (folder_ / "table.toml").string(), "--events", "-"});
    }
    /// The states in the order in which they came, each once.
    static std::vector<std::string> states(const ProgramResult& result) {
        std::vector<std::string> states;
        std::istringstream lines(result.out);
        for (std::string line; std::getline(lines, line);) {
            const std::string state = nlohmann::json::parse(line).at("state");
            if (states.empty() || states.back() != state) states.push_back(state);
        }
        return states;
    }
    std::string bytes() const {
        std::ifstream file(scan_, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    void write(const std::string& bytes) { std::ofstream(scan_, std::ios::binary) << bytes; }

    TemporaryFolder folder_;
    std::filesystem::path scan_ = folder_ / "table.scan";
    const std::vector<std::string> anew{"scanning", "live"};
};

TEST_F(SavedScanTest, FirstStartScansAndTheNextGoesOnWithIt) {
    const ProgramResult first = play("sim:mixed?seed=3&hands=0&frames=24");
    ASSERT_EQ(first.status, 0) << first.err;
    EXPECT_EQ(states(first), anew);
    const SavedScan scan = load_scan(scan_);
    EXPECT_FALSE(scan.volume.bricks.empty());
    EXPECT_EQ(scan.keyframes.size(), 1u);
    // The same table, seen by a camera that was knocked between the two starts.
    const ProgramResult second = play("sim:mixed?seed=3&hands=0&frames=40&knock_s=0&knock_deg=3&knock_mm=20");
    ASSERT_EQ(second.status, 0) << second.err;
    EXPECT_EQ(states(second), (std::vector<std::string>{"starting", "live"})) << second.err;
    EXPECT_THAT(second.err, HasSubstr("the saved scan fits"));
    EXPECT_THAT(second.err, testing::Not(HasSubstr("what does not fit")));
}

/// A ridge that was not there when the flat table was scanned: most of the view lies on the scan.
TEST_F(SavedScanTest, WhereTheRoomWasChangedItIsSaidWhatBecomesOfTheChange) {
    ASSERT_EQ(play("sim:flat?seed=3&hands=0&frames=24").status, 0);
    const ProgramResult second = play("sim:curved?seed=3&hands=0&frames=40");
    ASSERT_EQ(second.status, 0) << second.err;
    EXPECT_EQ(states(second), (std::vector<std::string>{"starting", "live"})) << second.err;
    EXPECT_THAT(second.err, HasSubstr("what does not fit is taken for people and things on the table"));
}

TEST_F(SavedScanTest, AnotherTableIsScannedAnewAndWritten) {
    ASSERT_EQ(play("sim:cluttered?seed=3&hands=0&frames=24").status, 0);
    const std::string of_first = bytes();
    const ProgramResult second = play("sim:bowl?seed=8&hands=0&frames=120&height=1.3");
    ASSERT_EQ(second.status, 0) << second.err;
    EXPECT_EQ(states(second), (std::vector<std::string>{"starting", "scanning", "live"})) << second.err;
    EXPECT_THAT(second.err, HasSubstr("does not fit the view"));
    EXPECT_TRUE(bytes() != of_first);
}

TEST_F(SavedScanTest, DamagedFilesAreSaidAndScannedAnew) {
    ASSERT_EQ(play("sim:flat?seed=3&hands=0&frames=24").status, 0);
    const std::string whole = bytes();
    std::string flipped = whole, other_version = whole;
    flipped[whole.size() / 2] ^= 1;
    other_version[8] ^= 2;
    for (const std::string& damaged : {flipped, other_version, whole.substr(0, 100), std::string()}) {
        write(damaged);
        const ProgramResult result = play("sim:flat?seed=3&hands=0&frames=24");
        ASSERT_EQ(result.status, 0) << result.err;
        EXPECT_EQ(states(result), anew);
        EXPECT_THAT(result.err, HasSubstr("table.scan"));
        EXPECT_THAT(result.err, HasSubstr("scanning anew"));
        EXPECT_TRUE(bytes() == whole) << "written again";
    }
}

TEST_F(SavedScanTest, AFileThatCannotBeWrittenIsSaidAndTheTableWorks) {
    scan_ = folder_ / "none" / "table.scan";
    const ProgramResult result = play("sim:flat?seed=3&hands=0&frames=24");
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(states(result), anew);
    EXPECT_THAT(result.err, HasSubstr("the next start scans anew"));
}

}  // namespace
}  // namespace touchstone
