#pragma once

#include <limits>
#include <optional>

#include "tests/accuracy/baselines/background.hpp"
#include "tests/accuracy/baselines/baseline.hpp"
#include "tests/accuracy/baselines/point_tracker.hpp"

namespace touchstone::baselines {

/// A touch is a blob of pixels whose height over the background lies in a band.
struct BandTouchConfig {
    enum class Kind { one_frame, largest, statistics };
    Kind background = Kind::one_frame;
    int background_frames = 1;    ///< of one_frame: the number of the frame, counted from 1
    float least_mm = 0.0F;        ///< lower end of the band, included
    float added_sd_mm = 0.0F;     ///< to the background's spread
    float least_sd = 0.0F;        ///< and lower end in spreads of the background, not included
    float most_mm = 0.0F;         ///< upper end, included
    int boxcar_px = 1;            ///< side
    int boxcar_kept_above = 127;  ///< of 255
    std::size_t least_px = 1;     ///< of a blob
    double gate_px = std::numeric_limits<double>::infinity();
    int missing_frames = 0;
};

class BandTouch : public Baseline {
  public:
    explicit BandTouch(const BandTouchConfig& config)
        : config_(config), tracker_(config.gate_px, config.missing_frames) {}

    std::vector<PixelTouch> process(const DepthPicture& picture) override;

  private:
    void learn(const DepthPicture& picture);
    Mask band(const DepthPicture& picture) const;

    BandTouchConfig config_;
    Readings readings_;
    std::optional<Background> background_;
    PointTracker tracker_;
};

/// Wilson, Using a depth camera as a touch sensor (2010), as the comparisons of DIRECT (2016) have it: the
/// background is frame 30, the largest of 16 readings, or mean and spread of 100.
BandTouchConfig wilson_single();
BandTouchConfig wilson_max();
BandTouchConfig wilson_stat();
/// KinectTouch. Its blobs are measured by their contour there, by their pixels here.
BandTouchConfig kinect_touch();
/// Wilson's third with a spread that no pixel of a quantising sensor is below, and larger blobs.
BandTouchConfig wilson_stat_for_steps();

}  // namespace touchstone::baselines
