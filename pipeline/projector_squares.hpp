#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "pipeline/projector_fit.hpp"

namespace touchstone {

/// Bright squares at known pixels of a projector: a quick look where its light falls. First all are dark,
/// then all are lit, then for each bit of a square's number those that have it.
struct ProjectorSquares {
    int width_px = 0, height_px = 0;            ///< of the projector's picture
    int side_px = 0;                            ///< of a square
    std::vector<Eigen::Vector2i> corners_px{};  ///< upper left pixel of each

    int bits() const;
    int patterns() const { return 2 + bits(); }
    bool is_lit(int pattern, int square) const;
    /// Pixel centres lie at whole numbers.
    Eigen::Vector2f middle_px(int square) const;
};

/// At most twelve, spread over the area, where the surface is even and the projector lights it if the model
/// is right. `points_g_m`: of each pixel of the camera, row-major, x, y, z, 1; all 0 where there is none.
ProjectorSquares choose_squares(const ProjectorModel& model, std::span<const Eigen::Vector4f> points_g_m,
                                int camera_width_px, const InteractiveArea& area_g);

/// Grey, 0 or 255 a pixel, row-major, row 0 at the top.
std::vector<std::uint8_t> draw_pattern(const ProjectorSquares& squares, int pattern);

/// What a camera saw of them.
struct SeenSquares {
    int lights = 0;                       ///< spots that came and went, whether a square or not
    std::vector<ProjectorMatch> matches;  ///< a square's middle, and where on the surface it was seen
};

/// `seen`: one grey picture a pattern, in their order, as many pixels as `points_g_m`. Throws Error{bad_data}
/// for another number or size.
SeenSquares find_squares(const ProjectorSquares& squares, std::span<const std::vector<float>> seen,
                         std::span<const Eigen::Vector4f> points_g_m, int camera_width_px);

enum class CheckVerdict {
    right,
    off,     ///< light falls elsewhere than the model says
    beside,  ///< there is light, but where there is no surface, or none that can be told from other light
    unseen,  ///< the camera saw no light: nothing is known
    too_few  ///< squares that the model lets fall on even surface: nothing is known
};

/// Where light falls, against where a model says.
struct ProjectorCheck {
    CheckVerdict verdict = CheckVerdict::unseen;
    int shown = 0, found = 0;
    float off_mm = 0.0f, off_px = 0.0f;  ///< medians over the squares that were found
};

/// The model is right where half of the squares lie within `limit_mm`.
ProjectorCheck judge_squares(const ProjectorModel& model, int shown, const SeenSquares& seen,
                             const InteractiveArea& area_g, float limit_mm);

/// For people: how far off, and what to do.
std::string describe(const ProjectorCheck& check);

}  // namespace touchstone
