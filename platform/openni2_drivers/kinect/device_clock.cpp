#include "platform/openni2_drivers/kinect/device_clock.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace touchstone {
namespace {

constexpr std::int64_t ticks_per_us = 60;
constexpr std::int64_t wrap_ticks = std::int64_t{1} << 32;
constexpr std::int64_t tolerance_ticks = 2'000'000 * ticks_per_us;

/// `ticks` plus that multiple of the wrap that lies nearest to `expected`.
std::int64_t unwrap(std::int64_t ticks, std::int64_t expected) {
    const double wraps = static_cast<double>(expected - ticks) / static_cast<double>(wrap_ticks);
    return ticks + wrap_ticks * std::llround(wraps);
}

}  // namespace

std::uint64_t DeviceClock::time_us(std::uint32_t ticks, std::uint64_t host_us) {
    const auto host = static_cast<std::int64_t>(host_us);
    std::int64_t now = ticks;
    if (last_) {
        const std::int64_t expected = last_->ticks + (host - last_->host_us) * ticks_per_us;
        now = unwrap(now + restart_ticks_, expected);
        if (std::abs(now - expected) > tolerance_ticks) {
            restart_ticks_ += expected - now;
            now = expected;
        }
    }
    if (!last_ || now > last_->ticks) last_ = Reading{now, host};
    return static_cast<std::uint64_t>(now / ticks_per_us);
}

}  // namespace touchstone
