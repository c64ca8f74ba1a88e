// The sensor that toolchain/run shows where there is no camera.
#include <fstream>
#include <gtest/gtest.h>

#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

const std::string simulated = "--sensor\nsim:mixed\n";

class SensorArguments : public testing::Test {
  protected:
    void plug_in(const std::string& vendor, const std::string& product) const {
        const std::filesystem::path device = devices_ / ("1-" + vendor);
        std::filesystem::create_directory(device);
        std::ofstream(device / "idVendor") << vendor << '\n';
        std::ofstream(device / "idProduct") << product << '\n';
    }
    std::string configuration(const std::string& text) const {
        std::ofstream(folder_ / "table.toml") << text;
        return (folder_ / "table.toml").string();
    }
    std::string found(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {TOUCHSTONE_SOURCE_DIR "/toolchain/sensor_arguments",
                                             TOUCHSTONE_PROGRAM, devices_.path().string()});
        const test::ProgramResult result = test::run_program(arguments);
        EXPECT_EQ(result.status, 0) << result.err;
        return result.out;
    }

    const TemporaryFolder folder_, devices_;
};

TEST_F(SensorArguments, WithoutCameraAndNameItIsTheSimulatedTable) {
    plug_in("1d6b", "0002");
    for (const char* command : {"run", "scan", "bench", "calibrate"})
        EXPECT_EQ(found({command, "--frames", "9"}), simulated) << command;
    EXPECT_EQ(found({"check"}), "") << "it looks for cameras";
}

TEST_F(SensorArguments, AnAttachedCameraIsShown) {
    plug_in("045e", "02ae");
    EXPECT_EQ(found({"run"}), "");
}

TEST_F(SensorArguments, WhatIsNamedIsShown) {
    EXPECT_EQ(found({"run", "--sensor", "sim:flat"}), "");
    EXPECT_EQ(found({"run", "--sensor=sim:flat"}), "");
    EXPECT_EQ(found({"run", "--print-config"}), "") << "it shows nothing";
}

TEST_F(SensorArguments, AConfigurationMayNameIt) {
    const std::string file = configuration("[sensor]\nuri = \"sim:curved\"\n");
    EXPECT_EQ(found({"run", "--config", file}), "");
    EXPECT_EQ(found({"run", "--config=" + file}), "");
    EXPECT_EQ(found({"run", "--config", configuration("[sensor]\nuri = 3\n")}), "")
        << "the program is to say what is wrong with it";
}

TEST_F(SensorArguments, ASimulationLeavesTheFilesOfARealTableAlone) {
    const std::string file = configuration("[scan]\nfile = \"table.scan\"\n");
    EXPECT_EQ(found({"run", "--config", file, "--frames", "9"}), simulated + "--keep-nothing\n");
    EXPECT_EQ(found({"run", "--config=" + file}), simulated + "--keep-nothing\n");
    EXPECT_EQ(found({"calibrate", "--config", file}), simulated) << "it is asked to write one";
}

}  // namespace
}  // namespace touchstone
