#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pipeline/camera_tracking.hpp"
#include "pipeline/relocalisation.hpp"

namespace touchstone {

struct CameraWatchConfig {
    SensorNoise noise{0.0012f, 0.0019f, 0.4f, 0.0001f};
    int every_frames = 2;          ///< one look in so many frames
    float fit_distance_m = 0.04f;  ///< a pixel fits when it is nearer to the model than this
    float fit_sigmas = 6.0f;       ///< and than so many sigmas
    /// What the fitting pixels ask for, where the noise is that at 1 m (elsewhere in proportion to it); more
    /// is a knock when so many looks in a row ask for it: the sensor's own leaps are followed sooner.
    float max_step_m = 0.003f, max_step_deg = 0.2f;
    int step_looks = 8;
    float sudden_steps = 2.0f;      ///< times those, at once: looked into
    float doubtful_fit = 0.9f;      ///< of the usual share: nothing is learnt and reported
    int doubtful_looks = 10;        ///< at most in a row
    float suspicious_fit = 0.85f;   ///< of the usual share of background pixels that fit
    float suspicious_seen = 0.35f;  ///< of the usual background pixels that are in view
    float min_gain = 0.1f;          ///< by which the knock must explain more of the view than no knock
    float min_rms_gain = 0.75f;     ///< or to what it must bring the residuals down
    float min_fit = 0.4f;           ///< of the view that a knock must explain
    float strange_fit = 0.5f;       ///< as suspicious_fit ...
    int strange_looks = 4;          ///< ... so often in a row: knocked out of ICP's reach
    float min_seen = 0.15f;         ///< as suspicious_seen: with less nothing is strange
};

enum class CameraVerdict {
    still,
    doubtful,  ///< the next looks will tell
    moved
};

/// Proves while live that a fixed camera has not moved, at the cost of one evaluation of ICP on the coarsest
/// level. What people do in front of the background is no movement of the camera.
class CameraWatch {
  public:
    CameraWatch(const Device& device, const CameraWatchConfig& config, const Intrinsics& intrinsics);

    /// The last look, in the camera frame of the prediction.
    struct Look {
        float fit = 0.0f;    ///< share of the background pixels in view that fit the model
        float seen = 0.0f;   ///< background pixels in view / those usually in view
        Displacement step;   ///< that the fitting ones ask for
        float noise = 1.0f;  ///< of the fitting pixels, 1 as at 1 m
        int looks = 0;       ///< since the start
    };

    /// `live` needs no normals. `foreground`: pixels other than 0 are left out.
    CameraVerdict judge(const LiveMaps& live, const SurfacePrediction& background,
                        const Buffer<std::uint8_t>& foreground);
    /// Learns anew what is usual: the prediction is another.
    void restart();
    const Look& last_look() const { return look_; }

  private:
    void look(const LiveMaps& live, const SurfacePrediction& background,
              const Buffer<std::uint8_t>& foreground);
    bool steps_more_than(const Displacement& step, float times) const;
    bool is_explained_by_a_knock(const LiveMaps& live, const SurfacePrediction& background);

    CameraWatchConfig config_;
    CameraTracking fitting_, aligning_;
    std::vector<RigidTransform> guesses_;
    Look look_;
    double usual_fit_ = 0.0, usual_seen_ = 0.0, usual_noise_ = 0.0;
    int frame_ = 0, stepping_ = 0, strange_ = 0, doubtful_ = 0;
};

}  // namespace touchstone
