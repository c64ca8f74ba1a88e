#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "platform/camera/depth_frame.hpp"

namespace touchstone {

/// What a camera does that only seems to live.
struct CameraFault {
    std::string_view word;  ///< for names of files and for counting
    std::string_view text;  ///< for people
};
inline constexpr CameraFault silent_camera{"silent", "The depth camera gives no pictures"};
inline constexpr CameraFault frozen_camera{"frozen",
                                           "The depth camera gives the same picture again and again"};
inline constexpr CameraFault blind_camera{"blind", "The depth camera sees nothing: is it covered?"};
inline constexpr CameraFault torn_camera{"torn", "The depth camera gives torn pictures"};

enum class FrameHealth {
    good,
    frozen,  ///< the same picture, pixel by pixel, half a second long: a real sensor's noise forbids that
    blind,   ///< no depth anywhere, half a second long
    torn,    ///< rows of the picture before among its own
};

/// Tells pictures of a live camera from those of one that only seems to live.
class FrameJudge {
  public:
    FrameHealth judge(const DepthFrame& frame);

  private:
    bool is_torn(const DepthFrame& frame) const;

    std::vector<std::uint16_t> last_mm_;
    int same_ = 0, blind_ = 0;
};

/// A camera's clock that jumps by more than 2 s against the host's goes on as if it had not.
class SteadyTime {
  public:
    /// Both in microseconds.
    std::uint64_t steady_us(std::uint64_t camera_us, std::uint64_t host_us);
    int jumps() const { return jumps_; }

  private:
    struct Reading {
        std::int64_t time_us, host_us;
    };
    std::optional<Reading> last_;
    std::int64_t offset_us_ = 0;
    int jumps_ = 0;
};

}  // namespace touchstone
