// The Debian package without installing it, its manual and its completion.
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <regex>
#include <set>
#include <sys/stat.h>

#include "tests/support/run_program.hpp"

namespace touchstone {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::vector<std::string> commands{"run",   "scan",  "track",  "calibrate", "record",
                                        "bench", "check", "notice", "reset"};

std::string content(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::set<std::string> options_of(const std::string& command) {
    const std::string help = test::run_program({TOUCHSTONE_PROGRAM, command, "--help"}).out;
    const std::regex option("(^|[ ,])(--[a-z-]+)");
    std::set<std::string> options;
    std::istringstream lines(help);
    for (std::string line; std::getline(lines, line);) {
        std::smatch match;
        if (line.starts_with("  -") && std::regex_search(line, match, option)) options.insert(match[2]);
    }
    return options;
}

TEST(Manual, HasEveryCommandAndOption) {
    std::string manual = content(fs::path(TOUCHSTONE_SOURCE_DIR) / "docs/touchstone.1");
    std::erase(manual, '\\');
    for (const std::string& command : commands) {
        EXPECT_THAT(manual, HasSubstr(fmt::format("\n.B {}\n", command)));
        const std::set<std::string> options = options_of(command);
        EXPECT_GE(options.size(), 2u) << command;
        for (const std::string& option : options) EXPECT_THAT(manual, HasSubstr(option)) << command;
    }
}

TEST(Completion, OffersEveryCommandAndOption) {
    const std::string file =
        (fs::path(TOUCHSTONE_SOURCE_DIR) / "toolchain/completion/touchstone.bash").string();
    const auto offered = [&](const std::string& words) {
        const std::string script = fmt::format(
            "source {}; COMP_WORDS=(touchstone {}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); "
            "_touchstone; printf '%s\\n' \"${{COMPREPLY[@]}}\"",
            file, words);
        std::istringstream lines(test::run_program({"/bin/bash", "-c", script}).out);
        std::set<std::string> answers;
        for (std::string line; std::getline(lines, line);) answers.insert(line);
        return answers;
    };
    const std::set<std::string> all = offered("''");
    EXPECT_EQ(all, std::set(commands.begin(), commands.end()));
    for (const std::string& command : commands) {
        const std::set<std::string> options = offered(fmt::format("{} --", command));
        for (const std::string& option : options_of(command))
            EXPECT_TRUE(options.contains(option)) << command << option;
    }
    EXPECT_TRUE(offered("run --scene ''").contains("mirror"));
    EXPECT_TRUE(offered("--").contains("--version"));
}

/// Built from this tree, taken apart into a folder and run from there.
TEST(Package, HasWhatItNeedsAndRuns) {
    if (!fs::exists("/usr/bin/dpkg-shlibdeps")) GTEST_SKIP() << "no dpkg-shlibdeps: install dpkg-dev";
    const TemporaryFolder folder;
    const std::string config = (fs::path(TOUCHSTONE_BINARY_DIR) / "CPackConfig.cmake").string();
    const test::ProgramResult built =
        test::run_program({TOUCHSTONE_CPACK, "-G", "DEB", "-B", folder.path().string(), "--config", config});
    ASSERT_EQ(built.status, 0) << built.err;
    std::string package;
    for (const auto& entry : fs::directory_iterator(folder.path()))
        if (entry.path().extension() == ".deb") package = entry.path().string();
    const std::string control = test::run_program({"/usr/bin/dpkg-deb", "-f", package}).out;
    for (const char* needed :
         {"libsdl2-2.0-0", "libopenni2-0", "libfreenect0.5", "pocl-opencl-icd | opencl-icd"})
        EXPECT_THAT(control, HasSubstr(needed));
    const fs::path root = folder / "root";
    ASSERT_EQ(test::run_program({"/usr/bin/dpkg-deb", "-x", package, root.string()}).status, 0);
    for (const char* file :
         {"usr/lib/systemd/system/touchstone.service", "usr/lib/systemd/system/touchstone-fallback.service",
          "usr/lib/systemd/system/touchstone-retry.timer",
          "usr/lib/udev/rules.d/70-touchstone-depth-cameras.rules", "etc/touchstone/touchstone.toml",
          "usr/share/man/man1/touchstone.1.gz", "usr/share/bash-completion/completions/touchstone",
          "usr/share/doc/touchstone/copyright", "usr/share/doc/touchstone/changelog.gz",
          "usr/share/doc/touchstone/examples/web/index.html"}) {
        struct stat found {};
        ASSERT_EQ(stat((root / file).c_str(), &found), 0) << file;
        EXPECT_EQ(found.st_mode & 0777, 0644u) << file;
    }
    fs::path drivers;
    for (const auto& entry : fs::recursive_directory_iterator(root))
        if (entry.path().filename() == "libTouchstoneSimulator.so.0") drivers = entry.path().parent_path();
    ASSERT_EQ(drivers.filename(), "Drivers");
    // OpenNI2 looks beside itself; it is not in the package.
    const fs::path library = drivers.parent_path().parent_path() / "libOpenNI2.so.0";
    fs::create_symlink(fs::read_symlink(fs::path(TOUCHSTONE_BINARY_DIR) / "openni2/libOpenNI2.so.0"),
                       library);
    const test::ProgramResult run =
        test::run_program({(root / "usr/bin/touchstone").string(), "run", "--sensor", "sim:flat?hands=1",
                           "--pace", "step", "--frames", "25", "--display", "headless", "--events", "-"},
                          {{"LD_LIBRARY_PATH", library.parent_path().string()}});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(std::ranges::count(run.out, '\n'), 25);
}

}  // namespace
}  // namespace touchstone
