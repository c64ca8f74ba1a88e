#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "platform/camera/depth_frame.hpp"

namespace touchstone {

/// The newest depth frames of a camera in memory, compressed without loss. Colour is not kept.
class FrameRing {
  public:
    /// Frames older than the newest by more than `span_s` are given up, and the oldest ones beyond
    /// `most_bytes` of compressed data.
    FrameRing(double span_s, std::size_t most_bytes) : span_s_(span_s), most_bytes_(most_bytes) {}

    /// A frame that does not go on from the last one - its number or time goes back, or its size is another -
    /// begins the ring anew: the camera is another one, or was opened again.
    void add(const DepthFrame& frame);
    void clear();

    std::size_t frames() const { return packed_.size(); }
    std::size_t bytes() const { return bytes_; }
    /// The frame at a place, 0 the oldest. Throws std::out_of_range.
    DepthFrame frame(std::size_t place) const;
    /// Of all its frames.
    const Intrinsics& intrinsics() const { return intrinsics_; }

  private:
    struct Packed {
        int index;
        std::uint64_t timestamp_us;
        std::string data;  ///< zstd of the low bytes of all pixels, then of their high bytes
    };
    bool goes_on(const DepthFrame& frame) const;
    std::string pack(const std::vector<std::uint16_t>& depth_mm);

    double span_s_;
    std::size_t most_bytes_, bytes_ = 0;
    Intrinsics intrinsics_{};
    std::deque<Packed> packed_;
    std::string planes_, compressed_;  ///< scratch
};

}  // namespace touchstone
