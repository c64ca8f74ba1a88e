#include "pipeline/radix_sort.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>
#include <random>

namespace touchstone {
namespace {

/// Against std::stable_sort, at counts around the length of a run and with many equal keys.
TEST(RadixSort, IsAStableSort) {
    const Device device(DeviceConfig{});
    for (const int count : {0, 1, 511, 512, 513, 5000}) {
        for (const int most : {3, 511, 512, 262143}) {
            std::mt19937 random(static_cast<unsigned>(count + most));
            std::uniform_int_distribution<int> any(0, most);
            std::vector<int> keys(5000), places(5000);
            std::ranges::generate(keys, [&] { return any(random); });
            std::iota(places.begin(), places.end(), 0);
            Buffer<int> device_keys(device, keys), device_places(device, places);
            RadixSort(device, 5000).sort(device_keys, device_places, count);
            std::ranges::stable_sort(places.begin(), places.begin() + count, {},
                                     [&](int place) { return keys[static_cast<std::size_t>(place)]; });
            const std::vector<int> found = device_places.read(), found_keys = device_keys.read();
            EXPECT_EQ(found, places) << count << " of 0.." << most;
            for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
                ASSERT_EQ(found_keys[i], keys[static_cast<std::size_t>(found[i])]);
        }
    }
}

}  // namespace
}  // namespace touchstone
