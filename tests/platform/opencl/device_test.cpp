#include "platform/opencl/device.hpp"

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

TEST(DeviceError, NamesCallCodeAndDevice) {
    const DeviceError error("clFinish", CL_OUT_OF_RESOURCES, "board");
    EXPECT_STREQ(error.what(), "clFinish: CL_OUT_OF_RESOURCES on board");
    EXPECT_EQ(error.code(), CL_OUT_OF_RESOURCES);
    EXPECT_EQ(opencl_error_name(-9999), "OpenCL error -9999");
}

}  // namespace
}  // namespace touchstone
