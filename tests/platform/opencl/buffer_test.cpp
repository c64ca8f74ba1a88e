#include "platform/opencl/buffer.hpp"

#include <gtest/gtest.h>
#include <numeric>

namespace touchstone {
namespace {

TEST(Buffer, WhatIsWrittenIsRead) {
    const Device device(DeviceConfig{});
    std::vector<int> values(1000);
    std::iota(values.begin(), values.end(), -500);
    Buffer<int> buffer(device, values);
    EXPECT_EQ(buffer.read(), values);
    buffer.fill(7);
    EXPECT_EQ(buffer.read(), std::vector<int>(1000, 7));
}

TEST(Buffer, MappingsAreSeenByLaterMappings) {
    const Device device(DeviceConfig{});
    Buffer<float> buffer(device, 8);
    {
        const auto mapped = buffer.map_write();
        std::iota(mapped.values().begin(), mapped.values().end(), 1.0f);
    }
    {
        const auto mapped = buffer.map_update();
        mapped[3] *= 10.0f;
    }
    EXPECT_EQ(buffer.read(), (std::vector<float>{1, 2, 3, 40, 5, 6, 7, 8}));
    EXPECT_EQ(buffer.map_read(2).size(), 2u);
}

TEST(Buffer, CopiesTheSmallerSize) {
    const Device device(DeviceConfig{});
    const Buffer<int> small(device, std::vector<int>{1, 2, 3});
    Buffer<int> large(device, 5);
    large.fill(9);
    large.copy_from(small);
    EXPECT_EQ(large.read(), (std::vector<int>{1, 2, 3, 9, 9}));
}

TEST(Buffer, ImpossibleSizeIsADeviceError) {
    const Device device(DeviceConfig{});
    EXPECT_THROW(Buffer<float>(device, std::size_t{1} << 45), DeviceError);
}

}  // namespace
}  // namespace touchstone
