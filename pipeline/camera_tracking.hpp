#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "pipeline/maps.hpp"
#include "pipeline/pose_solver.hpp"
#include "pipeline/types.hpp"
#include "platform/opencl/program.hpp"

namespace touchstone {

/// Good: fuse. Poor: follow the pose, but do not fuse. Lost: the pose is not to be believed.
enum class TrackingState { good, poor, lost };

/// One level of the coarse-to-fine alignment.
struct TrackingLevel {
    int iterations = 4;
    float max_distance_m = 0.1f;  ///< between the two vertices of a pair
    float cutoff_sigmas = 12.0f;  ///< of the residual
    int row_step = 1;             ///< one row of pixels in so many is aligned
    float stop_step_m = 2e-5f;    ///< an iteration that moves less ends the level
};

struct CameraTrackingConfig {
    SensorNoise noise{0.0012f, 0.0019f, 0.4f, 0.0001f};  ///< Kinect v1, Nguyen et al. 2012
    std::array<TrackingLevel, 3> levels{TrackingLevel{4, 0.06f, 8.0f, 2, 1e-4f},
                                        TrackingLevel{6, 0.10f, 16.0f, 2, 1e-4f},
                                        TrackingLevel{10, 0.20f, 60.0f, 1, 2e-4f}};  ///< fine to coarse
    float max_normal_angle_deg = 60.0f;
    float huber_sigmas = 1.5f;
    float intensity_sigma = 0.07f;  ///< of brightness 0..1 between two frames
    float half_sample_gap_per_m = 0.03f;
    float normal_gap_per_m = 0.03f;
    bool finds_normals = false;     ///< of the finest level, too: those of the live maps are not there yet
    float min_eigenvalue = 0.008f;  ///< directions below it are held
    /// The noise of a young model's normals looks like a constraint, and averages away: of so many frames,
    /// directions below this divided by their number are held, too.
    float young_min_eigenvalue = 0.09f;

    float poor_inlier_share = 0.5f, lost_inlier_share = 0.25f;  ///< of the pixels that have a model
    float min_model_share = 0.10f;                              ///< of the live pixels; less is lost
    /// Of the same; a camera that turns by 6 degrees a frame goes down to 0.21 in a right pose.
    float poor_close_share = 0.2f, lost_close_share = 0.1f;
    float max_step_m = 0.15f, max_step_deg = 12.0f;  ///< a frame; more is not believed
};

struct TrackingResult {
    TrackingState state = TrackingState::lost;
    std::string reason;  ///< in words for people, empty when good
    RigidTransform T_p_c = RigidTransform::Identity();
    float rms_sigmas = 0.0f;    ///< of the residuals, in units of the sensor's noise
    float rms_mm = 0.0f;        ///< of the pairs that count
    float inlier_share = 0.0f;  ///< pairs that count / live pixels that have a model
    float close_share = 0.0f;   ///< pairs within 2 sigma / live pixels that have a model
    float model_share = 0.0f;   ///< live pixels that have a model / live pixels
    int held_directions = 0;    ///< of six, that the last iteration left as they were
    Vector6d eigenvalues = Vector6d::Zero();
    int iterations = 0;
    StepEvidence evidence;  ///< of T_p_c
};

/// Brightness 0..1 of a colour picture that is registered to the depth camera, and its halves.
struct IntensityMaps {
    IntensityMaps(const Device& device, const Intrinsics& intrinsics);
    std::array<Buffer<float>, 3> levels;
};

/// The same point of the scene as two cameras saw it.
struct IntensityPair {
    const IntensityMaps& live;
    const IntensityMaps& model;  ///< of the camera that the prediction is of
};

/// Which live pixels are aligned.
struct LivePixels {
    const Buffer<std::uint8_t>* excluded = nullptr;  ///< those that are not 0 are left out; null: none
    /// Work is done in whole blocks of 64 pixels around it, in which all counts that is not excluded; normals
    /// at the blocks' rim are not to be relied on. Empty: the whole picture.
    PixelRegion region{};
};

/// Where the points of a view are: twists turn about their middle, and rotations are counted as the movement
/// of a point at their spread (root mean square distance from it).
struct ViewExtent {
    Eigen::Vector3f centre_c_m{0.0f, 0.0f, 1.0f};
    float spread_m = 0.5f;
};

/// 6DOF pose of the camera against a prediction: Listing 1 and Eq 1, coarse to fine.
class CameraTracking {
  public:
    CameraTracking(const Device& device, const CameraTrackingConfig& config, const Intrinsics& intrinsics);

    /// `guesses` are poses of the live camera in the prediction's camera frame p; the one that fits best at
    /// the coarsest level is refined, the first where none is clearly better. `intensity`: null, or what both
    /// cameras saw. `model_frames`: fused so far.
    TrackingResult track(const LiveMaps& live, const SurfacePrediction& model,
                         std::span<const RigidTransform> guesses, const IntensityPair* intensity = nullptr,
                         const LivePixels& pixels = {}, int model_frames = 1000);

    /// Brightness of width x height pixels, 3 bytes each.
    void convert(std::span<const std::uint8_t> rgb, IntensityMaps& maps);

    /// Makes the levels that sum() reads; track() does it itself.
    void prepare(const LiveMaps& live, const LivePixels& pixels = {});
    /// The sums of one evaluation at a level, 0 = finest, of the frame last prepared, over one row in
    /// `row_step`; A and b with those of brightness where there is `intensity`.
    AlignmentSums sum(const SurfacePrediction& model, const RigidTransform& T_p_c, int level,
                      const IntensityPair* intensity = nullptr, int row_step = 1);

  private:
    struct Level {
        Intrinsics intrinsics{};
        MapShape shape{};
        PixelRegion region{};     // whole tiles
        Buffer<float> depth_m;    // at level 0 only where pixels are left out
        Buffer<float> normals_c;  // at level 0 only where they are to be found
    };

    RigidTransform best_guess(const SurfacePrediction& model, std::span<const RigidTransform> guesses);
    void refine(const SurfacePrediction& model, const IntensityPair* intensity, int level,
                TrackingResult& result);
    void find_normals(Level& level, const Buffer<float>& depth_m);
    const Buffer<float>& depth_m(int level) const;
    LaunchSize one_row_each(int level, int row_step) const;
    AlignmentSums read_sums(const LaunchSize& size) const;
    AlignmentParams params(int level) const;

    CameraTrackingConfig config_;
    Intrinsics intrinsics_;
    std::array<Level, 3> levels_;
    const Buffer<float>* finest_depth_m_ = nullptr;
    const Buffer<float>* finest_normals_c_ = nullptr;
    Program program_, conversion_;
    Kernel half_sample_, leave_out_, sum_alignment_, brightness_, half_intensity_, normal_map_;
    Buffer<float> sums_;
    Buffer<std::uint8_t> rgb_;
    ViewExtent extent_;  // of the live view
    float min_eigenvalue_ = 0.0f;
};

/// State and reason from the figures of a result.
void judge_tracking(const CameraTrackingConfig& config, TrackingResult& result);

/// Lost where the pose moved more than is believed between two frames.
void judge_step(const CameraTrackingConfig& config, const RigidTransform& step, TrackingResult& result);

}  // namespace touchstone
