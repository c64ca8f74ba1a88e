#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "kernels/shared_types.h"
#include "tests/accuracy/hand_truth.hpp"

namespace touchstone {

/// Errors of one surface against the truth, over pixels of many frames. Metres.
struct SurfaceErrors {
    double squares_m2 = 0.0;    ///< of what is left after a plane through the errors of 11 x 11 pixels
    std::size_t residuals = 0;  ///< inside hands, 3 pixels from any edge
    double absolute_m = 0.0;    ///< of all pixels of hands
    std::size_t pixels = 0;

    double noise_mm() const;
    double mean_mm() const;
};

/// Row-major pictures of one frame, metres, 0 = nothing.
struct ScoredSurface {
    std::span<const float> depth_m;
    SurfaceErrors* errors;
};

/// The parts first to last - 1 of one hand, as Picture counts them less one.
struct HandParts {
    int owner = 0;
    std::size_t first = 0, last = 0;
};
HandParts arm_parts(int owner, const sim::Hand& hand);
HandParts parts_before_the_arm(int owner, const sim::Hand& hand);

/// Adds one frame's errors of several surfaces over the same pixels: those where all of them and the truth
/// show these parts.
void add_surface_errors(const Intrinsics& k, const sim::Picture& truth, const HandParts& parts,
                        std::span<const ScoredSurface> surfaces);

/// Which delay of the truth explains a picture around a fingertip best.
class LagScore {
  public:
    static constexpr int delays = 7;  ///< -1 to 5 frames

    /// `truths[i]` is of i - 1 frames ago; `depth_m`: foreground over background.
    void add(const Intrinsics& k, std::span<const float> depth_m, std::span<const sim::Picture* const> truths,
             const Eigen::Vector2f& tip_px);
    /// Frames, between whole ones by a parabola; 0 where nothing was added.
    double lag_frames() const;
    std::size_t frames() const { return frames_; }

  private:
    std::array<double, delays> squares_{};
    std::size_t frames_ = 0;
};

struct ForegroundRun {
    std::string scene = "flat";
    int seed = 1;
    int frames = 600;
};

struct ForegroundScore {
    struct Errors {
        SurfaceErrors raw, filtered, shown;
    };
    Errors moving_arms, moving_hands;        ///< that move 3 mm a frame or more
    Errors still_arms, still_hands;          ///< the others
    LagScore raw_lag, shown_lag, model_lag;  ///< of fingertips that move as much
    double modelled_share = 0.0;             ///< of the foreground's pixels
    int volumes_made = 0, hand_visits = 0;
    double median_ms = 0.0, p99_ms = 0.0;  ///< of the stage
    double frame_median_ms = 0.0;
};

/// Two hands over a simulated table with Kinect noise and drift, through the pipeline.
ForegroundScore score_foreground(const ForegroundRun& run);

}  // namespace touchstone
