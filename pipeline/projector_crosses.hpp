#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pipeline/contact_means.hpp"
#include "pipeline/projector_fit.hpp"

namespace touchstone {

struct ProjectorCrossesConfig {
    float margin = 0.04f;        ///< of the picture's width and height, left free at its edges
    float patience_s = 12.0f;    ///< a cross that nobody touches is passed over: it may lie beside the table
    float apart_m = 0.04f;       ///< a touch so near to the last one is still of the cross before
    float same_m = 0.01f;        ///< two touches of a cross that lie farther apart are not of one place
    float most_drag_m = 0.012f;  ///< a finger that moves more while it touches is no touch of a point
};

/// Places of the surface that stand out from the area's plane, at most four, apart from one another, where a
/// finger can touch: touches there tell a pinhole from a homography. `points_g_m`: of each pixel of the
/// camera, row-major, x, y, z, 1; all 0 where there is none.
std::vector<Eigen::Vector3f> standing_out(std::span<const Eigen::Vector4f> points_g_m, int width_px,
                                          const InteractiveArea& area_g);

/// "Touch the crosses": marks in the projector's picture are shown one after the other and touched. The first
/// lie about its middle; once four are touched, the rest go to the edges of the area, where touches are seen,
/// and to what stands out of it. Then those that were touched are shown once more, and the mean of both
/// touches counts.
class ProjectorCrosses {
  public:
    ProjectorCrosses(int width_px, int height_px, const InteractiveArea& area_g,
                     std::vector<Eigen::Vector3f> standing_out_g_m = {},
                     const ProjectorCrossesConfig& config = {});

    /// To be shown now; none once it is over.
    std::optional<Eigen::Vector2f> cross_px() const;
    /// The touches of a frame.
    void take(std::span<const TouchEvent> touches, const RigidTransform& T_g_c, std::uint64_t timestamp_us);
    std::string words() const;
    int shown() const { return next_; }
    int wanted() const { return static_cast<int>(crosses_px_.size()); }
    const std::vector<ProjectorMatch>& matches() const { return matches_; }

  private:
    void keep(const ProjectorMatch& match);
    void go_on(std::uint64_t timestamp_us);
    void spread();
    void show_again();

    Eigen::Vector2f size_px_;
    InteractiveArea area_g_;
    std::vector<Eigen::Vector3f> standing_out_g_m_;
    ProjectorCrossesConfig config_;
    bool is_spread_ = false, is_second_round_ = false;
    std::vector<Eigen::Vector2f> crosses_px_;
    ContactMeans contacts_;
    std::vector<ProjectorMatch> matches_;  ///< one for each cross, once its touches agree
    std::optional<Eigen::Vector3f> last_touched_g_m_;
    std::string remark_;  ///< such as why the last touch did not count
    int next_ = 0;
    std::optional<std::uint64_t> since_us_;
};

}  // namespace touchstone
