#pragma once

#include <cstdint>
#include <optional>

namespace touchstone {

/// A clock of 60 MHz ticks that wraps every 71.6 s, as microseconds that do not. Ticks of depth and colour
/// may come slightly out of order; after a pause the host's clock tells how often it has wrapped.
class DeviceClock {
  public:
    /// The time of `ticks`, which arrived at `host_us` of any steady clock. A clock that began anew goes on
    /// where it was, by the host's clock.
    std::uint64_t time_us(std::uint32_t ticks, std::uint64_t host_us);

  private:
    struct Reading {
        std::int64_t ticks, host_us;
    };
    std::optional<Reading> last_;  ///< unwrapped
    std::int64_t restart_ticks_ = 0;
};

}  // namespace touchstone
