#pragma once

#include <cstdint>
#include <vector>

#include "platform/openni2_drivers/simulator/column_drift.hpp"

namespace touchstone::sim {

/// What a structured-light sensor makes of exact depth: everything happens to the disparity between the
/// projector's pattern and its picture, which is read in steps of 1/8 pixel.
class DepthNoise {
  public:
    /// The picture's size is a Kinect's, 640 x 480; focal length in pixels.
    DepthNoise(std::uint64_t seed, float focal_px, bool noise, bool drift);

    /// Depth is metres, infinite where there is nothing to see; gives millimetres, 0 = no reading. Equal
    /// seed, frame and depth give equal output.
    void apply(const std::vector<float>& depth_m, int frame, double time_s,
               std::vector<std::uint16_t>& depth_mm);

  private:
    struct Moved {
        std::uint32_t pixel;
        float disparity_px;
    };

    void find_disparity(const std::vector<float>& depth_m);
    void find_edges();
    void cast_shadows();
    void jitter_edges(int frame);
    void drop_grazing(int frame);
    void quantise(int frame, double time_s, std::vector<std::uint16_t>& depth_mm);
    void add_specks(int frame, std::vector<std::uint16_t>& depth_mm) const;
    void only_drift(double time_s, std::vector<std::uint16_t>& depth_mm);

    std::uint64_t seed_;
    float disparity_m_px_;  ///< focal length times baseline
    bool noise_;
    ColumnDrift drift_;
    bool drifts_;
    std::vector<float> disparity_;    ///< px; 0 = no reading
    std::vector<std::uint8_t> edge_;  ///< flags: beside a step in depth, seen at a grazing angle
    std::vector<Moved> moved_;
    std::vector<float> column_steps_;
    std::vector<float> noise_table_;  ///< correlated, toroidal, unit variance
    std::vector<std::uint16_t> mm_of_step_;
};

}  // namespace touchstone::sim
