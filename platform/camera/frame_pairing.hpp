#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "platform/camera/depth_frame.hpp"

namespace touchstone {

/// One colour picture as it came; no pixels: the source says that its frame has none.
struct ColorPicture {
    std::uint64_t timestamp_us = 0;
    int width_px = 0;
    int height_px = 0;
    std::vector<std::uint8_t> rgb;
};

/// Puts to each depth frame the colour picture nearest in time, at most 50 ms away, scaled to the depth's
/// size. Frames come out in the order they went in, each once.
class FramePairing {
  public:
    /// wait_for_color: a depth frame stays until a colour picture at least as new has come (recordings, where
    /// it will come); otherwise it takes what is there (live, where waiting would be latency).
    explicit FramePairing(bool wait_for_color) : wait_for_color_(wait_for_color) {}

    void add(DepthFrame frame) { depths_.push_back(std::move(frame)); }
    void add(ColorPicture picture);
    std::optional<DepthFrame> take();
    /// No more come.
    void forget_colors() { colors_.clear(); }
    /// After the last picture has come: no waiting any more.
    void finish() { wait_for_color_ = false; }

  private:
    bool wait_for_color_;
    std::deque<DepthFrame> depths_;
    std::deque<ColorPicture> colors_;
};

/// Nearest-neighbour scaling to width x height, 3 bytes a pixel.
std::vector<std::uint8_t> scale_nearest(const ColorPicture& picture, int width_px, int height_px);

}  // namespace touchstone
