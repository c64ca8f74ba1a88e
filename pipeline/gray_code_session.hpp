#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pipeline/gray_code.hpp"

namespace touchstone {

struct GrayCodeSessionConfig {
    int settle_frames = 5;       ///< between showing a pattern and seeing it: projectors are late
    int frames_per_pattern = 2;  ///< whose mean is taken
    int quiet_frames = 10;       ///< after a disturbance
    int most_disturbances = 60;  ///< patterns that were begun again, in all
    GrayDecodeConfig decode;
};

/// The patterns one after the other, each shown until it was seen undisturbed.
class GrayCodeSession {
  public:
    explicit GrayCodeSession(const GrayCode& code, const GrayCodeSessionConfig& config = {})
        : code_(code), config_(config), wait_(config.settle_frames) {}

    /// To be shown now; none once all were seen.
    std::optional<int> pattern() const;
    /// A colour picture while that pattern is shown, 3 bytes a pixel, row-major. `disturbed`: a hand is in
    /// the view or the camera was moved. The pattern before may have been touched by what is seen only now:
    /// it is repeated, too. Throws Error{bad_data} where pictures change their size or something disturbs for
    /// ever.
    void take(std::span<const std::uint8_t> rgb, bool disturbed);
    bool is_disturbed() const { return quiet_ > 0; }
    /// Times that patterns were begun again.
    int disturbances() const { return disturbances_; }
    /// Once all were seen, in the pixels of that camera.
    CellPicture cells(int width_px, int height_px) const;
    const GrayCode& code() const { return code_; }

  private:
    void begin_again();

    GrayCode code_;
    GrayCodeSessionConfig config_;
    std::vector<std::vector<float>> seen_;
    std::vector<float> sum_;
    int frames_ = 0, wait_ = 0, quiet_ = 0, disturbances_ = 0;
    bool is_over_ = false;  ///< a frame after the last pattern was undisturbed, too
};

}  // namespace touchstone
