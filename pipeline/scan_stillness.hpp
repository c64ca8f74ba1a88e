#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/maps.hpp"
#include "platform/opencl/program.hpp"

namespace touchstone {

struct ScanStillnessConfig {
    SensorNoise noise{0.0012f, 0.0019f, 0.4f, 0.0001f};  ///< Kinect v1, Nguyen et al. 2012
    float quantisation_per_m = 0.00084f;  ///< standard deviation of 1/z by rounding to steps of disparity
    float sigmas = 4.0f;                  ///< a depth that differs by less has not changed
    int least_frames = 5;                 ///< in a row that show a surface before it is believed
    float max_moving_share = 0.003f;      ///< of the picture: more is something that moves, not noise
    float max_unknown_share = 0.02f;      ///< of the picture that is not still yet: more is waited for ...
    int wait_frames = 300;                ///< ... so long
    int mover_wait_frames = 25;           ///< or, with all known, for what moves to leave
    int min_replaced_px = 200;  ///< of what was scanned and has left: the scan is made anew without it
};

/// What of the view stands still during the scan: only that becomes background.
class ScanStillness {
  public:
    ScanStillness(const Device& device, const ScanStillnessConfig& config, const Intrinsics& intrinsics);

    /// Takes the pixels that move out of both depth maps. Waits for the device.
    void judge(LiveMaps& live);
    /// Another scan.
    void restart();

    /// Shares of the picture, in the last frame; single pixels at edges flicker and do not count.
    float moving_share() const { return moving_share_; }
    float unknown_share() const { return unknown_share_; }
    bool something_moves() const { return moving_share_ > config_.max_moving_share; }
    bool much_is_unknown() const { return unknown_share_ > config_.max_unknown_share; }

    /// The still part of what was seen, all frames averaged.
    struct StillView {
        std::vector<float> depth_m;        ///< map; 0 where nothing stood still
        std::vector<std::uint8_t> frames;  ///< map; how many
        bool replaces_scan = false;        ///< what was fused so far holds things that have moved
    };
    StillView still_view() const;

  private:
    ScanStillnessConfig config_;
    MapShape shape_;
    Program program_;
    Kernel judge_stillness_;
    Buffer<float> mean_m_, other_m_;
    Buffer<std::uint8_t> frames_, other_frames_, moving_, replaced_;
    float moving_share_ = 0.0f, unknown_share_ = 0.0f;
};

}  // namespace touchstone
