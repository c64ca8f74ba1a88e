#include "platform/system/temperatures.hpp"

#include <fstream>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

TEST(Temperatures, AreThoseOfTheZonesThatHaveAReading) {
    const TemporaryFolder folder;
    const auto zone = [&](const char* name) {
        std::filesystem::create_directory(folder.path() / name);
        return folder.path() / name;
    };
    std::ofstream(zone("thermal_zone1") / "type") << "gpu-thermal\n";
    std::ofstream(folder.path() / "thermal_zone1" / "temp") << "48250\n";
    std::ofstream(zone("thermal_zone0") / "type") << "cpu-thermal\n";
    std::ofstream(folder.path() / "thermal_zone0" / "temp") << "-1500\n";
    std::ofstream(zone("thermal_zone2") / "type") << "asleep\n";
    zone("cooling_device0");
    const std::vector<Temperature> found = read_temperatures(folder.path());
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].zone, "cpu-thermal");
    EXPECT_DOUBLE_EQ(found[0].celsius, -1.5);
    EXPECT_EQ(found[1].zone, "gpu-thermal");
    EXPECT_DOUBLE_EQ(found[1].celsius, 48.25);
}

TEST(Temperatures, NoneWhereTheKernelShowsNone) { EXPECT_TRUE(read_temperatures("/nowhere/at/all").empty()); }

}  // namespace
}  // namespace touchstone
