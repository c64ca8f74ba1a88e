#include "platform/opencl/device.hpp"

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <unistd.h>

#include "platform/opencl/device_error.hpp"
#include "tests/support/expect_error.hpp"

namespace touchstone {
namespace {

TEST(Device, CpuCanBeAskedFor) {
    const Device device(DeviceConfig{.choice = "cpu", .cache_dir = {}});
    EXPECT_TRUE(device.is_cpu());
    EXPECT_THAT(device.fingerprint(), testing::HasSubstr(device.name()));
}

TEST(Device, PartOfTheNameChooses) {
    const Device any(DeviceConfig{});
    const Device named(DeviceConfig{.choice = any.name().substr(0, 6), .cache_dir = {}});
    EXPECT_FALSE(named.name().empty());
}

TEST(Device, UnknownNameListsWhatThereIs) {
    const Device any(DeviceConfig{});
    expect_error([] { Device(DeviceConfig{.choice = "Quantum 9000", .cache_dir = {}}); },
                 ExitStatus::unavailable,
                 testing::AllOf(testing::HasSubstr("Quantum 9000"), testing::HasSubstr(any.name())));
}

/// The cores that a thread of this process may use, as Linux writes them.
std::string allowed_cores(const std::filesystem::path& task) {
    std::ifstream status(task / "status");
    const std::string key = "Cpus_allowed_list:\t";
    for (std::string line; std::getline(status, line);)
        if (line.starts_with(key)) return line.substr(key.size());
    return {};
}

TEST(Device, EachThreadOfPoclHasACoreOfItsOwn) {
    const Device device(DeviceConfig{.choice = "cpu", .cache_dir = {}});
    const auto cores = static_cast<std::size_t>(sysconf(_SC_NPROCESSORS_ONLN));
    const std::string all = cores == 1 ? "0" : "0-" + std::to_string(cores - 1);
    if (!device.name().starts_with("pthread") || allowed_cores("/proc/self") != all)
        GTEST_SKIP() << "not PoCL, or kept to some cores";
    std::set<std::string> single;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
        const std::string list = allowed_cores(task.path());
        if (list != all) single.insert(list);
    }
    EXPECT_EQ(single.size(), cores == 1 ? 0 : cores);
}

TEST(DeviceError, NamesCallCodeAndDevice) {
    const DeviceError error("clFinish", CL_OUT_OF_RESOURCES, "board");
    EXPECT_STREQ(error.what(), "clFinish: CL_OUT_OF_RESOURCES on board");
    EXPECT_EQ(error.code(), CL_OUT_OF_RESOURCES);
    EXPECT_EQ(opencl_error_name(-9999), "OpenCL error -9999");
}

}  // namespace
}  // namespace touchstone
