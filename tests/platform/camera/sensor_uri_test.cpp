#include "platform/camera/sensor_uri.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include "tests/support/expect_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using ::testing::HasSubstr;

TEST(SensorUri, KindsByScheme) {
    EXPECT_EQ(classify_sensor("seq:/a/b"), SensorKind::sequence);
    EXPECT_EQ(classify_sensor("sim:flat?seed=3"), SensorKind::simulator);
    EXPECT_EQ(classify_sensor("/a/missing.oni"), SensorKind::recording);
    EXPECT_EQ(classify_sensor("1d27/0609@1/4"), SensorKind::device);
    EXPECT_EQ(classify_sensor("freenect://0"), SensorKind::device);
}

TEST(SensorUri, FilesAndFolders) {
    const TemporaryFolder folder;
    std::ofstream(folder / "recording") << "x";
    EXPECT_EQ(classify_sensor(folder / "recording"), SensorKind::recording);
    expect_error([&] { classify_sensor(folder.path()); }, ExitStatus::usage,
                 HasSubstr("seq:" + folder.path().string()));
}

TEST(SensorUri, ShortOnesStayAsTheyAre) {
    const OpenniUri uri("seq:/a", SensorKind::sequence);
    EXPECT_EQ(uri.text(), "seq:/a");
    EXPECT_EQ(uri.in_user_terms("about /a"), "about /a");
}

TEST(SensorUri, LongPathsAreShortenedAndTranslatedBack) {
    const TemporaryFolder folder;
    const auto deep = folder.path() / std::string(250, 'd');
    std::filesystem::create_directory(deep);
    const OpenniUri uri("seq:" + deep.string(), SensorKind::sequence);
    EXPECT_LT(uri.text().size(), 40U);
    const std::string path = uri.text().substr(4);
    EXPECT_TRUE(std::filesystem::equivalent(path, deep));
    EXPECT_EQ(uri.in_user_terms("bad " + path + "/x and " + path),
              "bad " + deep.string() + "/x and " + deep.string());
}

TEST(SensorUri, LongOnesThatNameNothingHaveTheirStatus) {
    const std::string missing = "/" + std::string(250, 'm') + "/" + std::string(250, 'n');
    expect_error([&] { OpenniUri("seq:" + missing, SensorKind::sequence); }, ExitStatus::no_input,
                 HasSubstr(missing));
    expect_error([&] { OpenniUri("sim:" + missing, SensorKind::simulator); }, ExitStatus::usage,
                 HasSubstr("255"));
}

}  // namespace
}  // namespace touchstone
