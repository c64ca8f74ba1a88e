#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kernels/shared_types.h"

namespace touchstone {

/// One depth picture with its colour picture, as a driver of ours hands it to OpenNI2.
struct SourceFrame {
    int index = 0;                        ///< the file's number, or counted from 0
    std::uint64_t timestamp_us = 0;       ///< of the source's clock
    std::vector<std::uint16_t> depth_mm;  ///< width x height, row-major, 0 = invalid
    std::vector<std::uint8_t>
        color_rgb;          ///< 3 bytes a pixel, row-major; empty when there is none for this frame
    bool withheld = false;  ///< made, but not handed over: a camera that stalls
    /// The camera is pulled out instead of giving this frame, its last one, and comes back after so long.
    std::optional<double> back_after_s;
};

enum class Pace {
    live,  ///< frames come at the source's rate, the reader takes the latest
    step,  ///< every frame in order, made when the reader asks
};

struct SourceInfo {
    Intrinsics intrinsics{};
    bool has_color = false;
    int color_width_px = 0;
    int color_height_px = 0;
    double rate_hz = 30.0;
    Pace default_pace = Pace::live;
    bool has_automatics = false;  ///< exposure and white balance of its colour camera can be held
};

/// What a driver of ours replays or makes up. The OpenNI2 plumbing (device, streams, pace, end of stream) is
/// one piece of code for all of them: source_driver.hpp.
class FrameSource {
  public:
    virtual ~FrameSource() = default;
    virtual const SourceInfo& info() const = 0;
    /// Colour is made only when a colour stream runs.
    virtual void enable_color(bool enabled) = 0;
    /// A reader has stopped and started its streams.
    virtual void restarted() {}
    /// Fills the next frame; false after the last one. Throws Error (system/error.hpp) on bad data.
    virtual bool next(SourceFrame& frame) = 0;
};

}  // namespace touchstone
