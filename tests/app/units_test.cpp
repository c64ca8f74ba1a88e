// The unit files by systemd's own tools.
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

#include "tests/support/run_program.hpp"

namespace touchstone {
namespace {

namespace fs = std::filesystem;

/// The units with the program where it was built: systemd-analyze looks whether it is there.
class Units : public testing::Test {
  protected:
    Units() {
        for (const auto& entry : fs::directory_iterator(fs::path(TOUCHSTONE_SOURCE_DIR) / "systemd")) {
            if (entry.path().extension() == ".toml") continue;
            std::ifstream file(entry.path());
            std::string text{std::istreambuf_iterator<char>(file), {}};
            const std::string installed = "/usr/bin/touchstone";
            for (std::size_t at = 0; (at = text.find(installed, at)) != std::string::npos; ++at)
                text.replace(at, installed.size(), TOUCHSTONE_PROGRAM);
            units_.push_back(folder_ / entry.path().filename().string());
            std::ofstream(units_.back()) << text;
        }
    }
    void SetUp() override {
        ASSERT_GE(units_.size(), 4u);
        if (!fs::exists("/usr/bin/systemd-analyze")) GTEST_SKIP() << "no systemd-analyze: install systemd";
    }

    TemporaryFolder folder_;
    std::vector<fs::path> units_;
};

TEST_F(Units, VerifySaysNothing) {
    std::vector<std::string> command{"/usr/bin/systemd-analyze", "verify", "--man=no"};
    for (const fs::path& unit : units_) command.push_back(unit.string());
    const test::ProgramResult result = test::run_program(command);
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.out + result.err, "");
}

/// What may write and remove there: the reports of faults lie in it.
TEST_F(Units, TheTableAndItsResetHaveTheFoldersThatTheConfigurationNames) {
    const auto content = [](const fs::path& path) {
        std::ifstream file(path);
        return std::string{std::istreambuf_iterator<char>(file), {}};
    };
    const fs::path config = fs::path(TOUCHSTONE_SOURCE_DIR) / "systemd/touchstone.toml";
    ASSERT_NE(content(config).find("fault_dir = \"/var/log/touchstone\""), std::string::npos);
    for (const char* unit : {"touchstone.service", "touchstone-factory-reset.service"})
        for (const char* setting : {"\nStateDirectory=touchstone\n", "\nLogsDirectory=touchstone\n",
                                    "\nWorkingDirectory=%S/touchstone\n"})
            EXPECT_NE(content(folder_ / unit).find(setting), std::string::npos) << unit << setting;
}

/// Of ten, in tenths.
TEST_F(Units, ExposureIsAtMostOnePointThree) {
    for (const fs::path& unit : units_) {
        if (unit.extension() != ".service") continue;
        const test::ProgramResult result = test::run_program(
            {"/usr/bin/systemd-analyze", "security", "--offline=yes", "--threshold=13", unit.string()});
        EXPECT_EQ(result.status, 0) << result.out;
        EXPECT_NE(result.out.find("Overall exposure level"), std::string::npos) << result.err;
    }
}

}  // namespace
}  // namespace touchstone
