#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "pipeline/interaction_pipeline.hpp"
#include "platform/camera/depth_frame.hpp"
#include "ui/operator_view.hpp"

namespace touchstone {

/// A picture of depths, as small as the operator needs it: near is bright.
Thumbnail depth_thumbnail(const DepthFrame& frame);
/// Of a map as large as the frame, in which 0 is black and all else white.
Thumbnail mask_thumbnail(std::span<const std::uint8_t> map, PixelSize size);

/// What the perception loop keeps for the operator: the last faults, small pictures while they are wanted,
/// and how far a recording is.
class OperatorDesk {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// What was asked for since the last wish; a count that went back is that of another display.
    OperatorWish take(const OperatorWish& wish);
    bool is_open() const { return wish_.open; }
    /// `clock` is the time of day that is shown.
    void note_fault(const std::string& word, const std::string& reason,
                    std::chrono::system_clock::time_point clock = std::chrono::system_clock::now());
    /// Takes pictures of a frame, only while they are wanted.
    void see(const DepthFrame& frame, const InteractionPipeline& pipeline);

    /// `dir` is where it will lie.
    void begin_recording(Time now, const std::string& dir);
    bool records() const { return recorded_at_.has_value(); }
    /// True once, when it is over.
    bool ends_recording(Time now);

    /// Faults, pictures and the recording; the rest is left to the caller.
    OperatorView view(Time now) const;

  private:
    OperatorWish wish_;
    std::deque<std::string> faults_;  ///< newest first
    Thumbnail depth_, mask_;
    std::optional<Time> recorded_at_;
    std::string recording_dir_;
    bool has_recorded_ = false;
};

}  // namespace touchstone
