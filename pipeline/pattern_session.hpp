#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace touchstone {

struct PatternSessionConfig {
    int settle_frames = 5;       ///< between showing a pattern and seeing it: projectors are late
    int frames_per_pattern = 2;  ///< whose mean is taken
    int quiet_frames = 10;       ///< after a disturbance
    int most_disturbances = 60;  ///< patterns that were begun again, in all
};

/// Patterns one after the other, each shown until a colour camera saw it undisturbed.
class PatternSession {
  public:
    PatternSession(int patterns, const PatternSessionConfig& config = {})
        : patterns_(patterns), config_(config), wait_(config.settle_frames) {}

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
    /// Grey, one picture for each pattern that was seen.
    const std::vector<std::vector<float>>& seen() const { return seen_; }

  private:
    void begin_again();

    int patterns_;
    PatternSessionConfig config_;
    std::vector<std::vector<float>> seen_;
    std::vector<float> sum_;
    int frames_ = 0, wait_ = 0, quiet_ = 0, disturbances_ = 0;
    bool is_over_ = false;  ///< a frame after the last pattern was undisturbed, too
};

}  // namespace touchstone
