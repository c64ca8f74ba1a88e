#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/foreground_segmentation.hpp"
#include "pipeline/maps.hpp"
#include "platform/opencl/program.hpp"

namespace touchstone {

struct ColumnDriftConfig {
    float disparity_step_per_m = 0.0029f;  ///< the sensor's unit of 1/z, 1/m
    float max_shift_steps = 3.0f;          ///< of disparity
    float gain = 0.08f;                    ///< of one frame: 1 / time constant in frames
    float leak = 0.0003f;                  ///< of the shift a frame, so that the model takes over what lasts
    float min_samples = 20.0f;             ///< pixels of a column, of those looked at; with less it is held
    float zone_gap_steps = 0.6f;  ///< a quarter of the rows that is farther than this from the column
    float max_dissent = 0.2f;     ///< ... disagrees; with a larger share of the pixels it is held
    int row_step = 4;             ///< each frame looks at every so many-th row, in turn
};

/// Histogram of a column's residuals in 1/z.
struct ResidualBins {
    std::array<float, DRIFT_BINS> counts{}, sums_per_m{};
};

/// Mean of the residuals within one disparity step of their median, 1/m; nothing with fewer than min_samples
/// or where the median lies at the end of the histogram.
std::optional<float> typical_residual_per_m(const ResidualBins& bins, const ColumnDriftConfig& config);

/// Follows the slow drift of a Kinect v1's column bands, which is a shift of 1/z for whole columns.
class ColumnDrift {
  public:
    ColumnDrift(const Device& device, const ColumnDriftConfig& config, const Intrinsics& intrinsics);

    /// What is to be added to 1/z of each column of the next frame, 1/m, width_px values: the argument of
    /// DepthMapConversion::set_column_shift(). `live` must have been converted with the last result.
    /// Pixels of the foreground's background_mask are not looked at. Columns with too little background, or
    /// whose parts disagree (something was put down), keep their shift.
    std::span<const float> update(const LiveMaps& live, const SurfacePrediction& background,
                                  const Foreground& foreground);

    /// The last result, zero before the first.
    std::span<const float> shift_per_m() const { return shift_per_m_; }
    /// Goes back to an earlier result; to zero where it is empty.
    void restore(std::span<const float> shift_per_m);

  private:
    void estimate_shifts();
    std::optional<float> column_residual(std::span<const float> counts, std::span<const float> sums,
                                         std::size_t column) const;

    ColumnDriftConfig config_;
    MapShape shape_;
    Program program_;
    Kernel column_residuals_;
    Buffer<float> counts_, sums_;
    std::vector<std::optional<float>> estimates_per_m_;
    std::vector<float> shift_per_m_;
    int next_row_ = 0;
};

}  // namespace touchstone
