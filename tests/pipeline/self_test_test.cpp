#include "pipeline/self_test.hpp"

#include <gtest/gtest.h>

namespace touchstone {
namespace {

TEST(SelfTest, PassesOnADeviceThatComputesRight) {
    const Device device(DeviceConfig{});
    EXPECT_NO_THROW(run_self_test(device));
}

}  // namespace
}  // namespace touchstone
