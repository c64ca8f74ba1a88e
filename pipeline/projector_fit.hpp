#pragma once

#include <span>
#include <string>

#include "pipeline/projector_model.hpp"

namespace touchstone {

/// A point of the scan, and the pixel of the projector that lights it.
struct ProjectorMatch {
    Eigen::Vector3f point_g_m{0.f, 0.f, 0.f};
    Eigen::Vector2f pixel_px{0.f, 0.f};
};

struct ProjectorFitConfig {
    float sigma_px = 0.5f;  ///< of a match that is right: what priors are weighed against
    float least_relief_m =
        0.005f;                  ///< rms of the points' distance from their plane: below, one plane is taken
    float least_spread = 0.25f;  ///< of the picture's width and height that the matches must cover
    float most_rms_px = 3.0f;    ///< above, the fit is not to be used
    int least_matches = 4;
};

enum class ProjectorVerdict { good, too_few, crowded, scattered };

/// What the matches tell of the projector.
struct ProjectorFit {
    ProjectorVerdict verdict = ProjectorVerdict::too_few;
    ProjectorModel model;   ///< of any use only where the verdict is good
    int matches = 0;        ///< that were given
    int used = 0;           ///< without those that are far from all others' model
    float rms_px = 0.0f;    ///< of those used: distance between pixel and projected point
    float rms_mm = 0.0f;    ///< the same on the surface
    float relief_m = 0.0f;  ///< of the points, rms
};

/// Fits a pinhole with lens distortion, or on a plane a homography. A robust homography of the main plane is
/// taken apart with likely focal lengths and lens shifts, and the best of these is refined on all matches by
/// Levenberg-Marquardt with loose priors (square pixels, little distortion), which a surface with little
/// relief needs: PAPER.md. A picture that is mirrored in the light path gives a negative focal length across.
/// `area_g`: where places of a homography are measured, and millimetres.
ProjectorFit fit_projector(std::span<const ProjectorMatch> matches, int width_px, int height_px,
                           const InteractiveArea& area_g, const ProjectorFitConfig& config = {});

/// How far from a match's point the light of its pixel falls, along the area, when the model is right;
/// metres. 0 where the model has no pixel for the point.
double light_off_m(const ProjectorModel& model, const ProjectorMatch& match, const InteractiveArea& area_g);

/// For people: how good it is, or what to change.
std::string describe(const ProjectorFit& fit);

}  // namespace touchstone
