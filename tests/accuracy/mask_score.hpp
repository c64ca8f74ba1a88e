#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace touchstone {

/// How foreground masks compare with the truth. A frame counts for the overlap if its truth has more than
/// 1500 foreground pixels, from the fourth such frame in a row on; for the false area if its truth is empty.
struct MaskScore {
    std::vector<double> overlap;  ///< IoU over the pixels with a depth reading, a frame each
    std::vector<double>
        false_area;   ///< share of the pixels with a depth reading that are marked, a frame each
    int missing = 0;  ///< frames without a mask from the program: they count as empty masks
};

/// Scores frames in their order.
class MaskScorer {
  public:
    /// All of one size: truth and mask have foreground where they are not 0, depth_mm is 0 where there is no
    /// reading.
    void take_frame(std::span<const std::uint8_t> truth, std::span<const std::uint8_t> mask,
                    std::span<const std::uint16_t> depth_mm);
    /// The same where the program wrote no mask.
    void take_missing(std::span<const std::uint8_t> truth, std::span<const std::uint16_t> depth_mm);
    const MaskScore& result() const { return score_; }

  private:
    MaskScore score_;
    int frames_with_foreground_ = 0;  ///< in a row
};

/// Scores `frame-%06d.foreground.png` of `run --maps` against `truth-%06d.mask.png` and
/// `frame-%06d.depth.png` of the simulator, from frame 60 on: those before are of the scan. Throws
/// Error{no_input} or Error{bad_data}.
MaskScore score_masks(const std::filesystem::path& truth_folder, const std::filesystem::path& maps_folder);

/// All figures, with the names of the independent scorer where it has them.
std::string json_of(const MaskScore& score);
/// One line for people.
std::string line_of(const MaskScore& score);

}  // namespace touchstone
