#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "pipeline/foreground_view.hpp"
#include "pipeline/types.hpp"
#include "pipeline/volume_snapshot.hpp"

namespace touchstone {

/// Where an object may be: found without a guess, to some 15 degrees and 2 cm.
struct ObjectCandidate {
    RigidTransform T_c_o = RigidTransform::Identity();  ///< object (its volume's frame) to camera
    float score = 0.0f;                                 ///< cells of the view that speak for it
};

struct ObjectTemplatesConfig {
    int directions = 80;           ///< it is looked at from, evenly over the sphere
    int turns = 15;                ///< about each
    float cell_m = 0.014f;         ///< of the coarse views
    int shifts = 2;                ///< cells that a view is moved by, to and fro, each way
    float reach_m = 0.06f;         ///< along the line of sight, to and fro
    float same_turn_deg = 30.0f;   ///< candidates that are closer than this are one
    float min_score_share = 0.2f;  ///< of a view's cells; candidates with less are none
    int most_points = 8000;        ///< of the surface
};

/// What an object looks like from all around, as coarse depth views.
class ObjectTemplates {
  public:
    ObjectTemplates(const ObjectTemplatesConfig& config, const VolumeSnapshot& object);

    std::size_t size() const { return templates_.size(); }
    const ObjectTemplatesConfig& config() const { return config_; }
    /// Middle of the object's surface, frame o.
    const Eigen::Vector3f& centre_o_m() const { return centre_o_m_; }
    /// Adds what the templates [first, end) find to `best`, the best first, at most `most`.
    void match(const ForegroundView& view, std::size_t first, std::size_t end, std::size_t most,
               std::vector<ObjectCandidate>& best) const;

  private:
    struct TemplateCell {
        int x = 0, y = 0;      ///< from the anchor
        float depth_m = 0.0f;  ///< from the anchor's
    };
    struct Template {
        Eigen::Matrix3f R_v_o = Eigen::Matrix3f::Identity();
        Eigen::Vector3f anchor_v_m = Eigen::Vector3f::Zero();  ///< from the centre
        std::vector<TemplateCell> cells;
    };
    struct Fit {
        float score = 0.0f, depth_m = 0.0f;
    };

    Template render(const Eigen::Matrix3f& R_v_o, std::span<const Eigen::Vector3f> points_m) const;
    Fit fit(const Template& at, const ForegroundView& view, int shift_x, int shift_y) const;
    void keep(const ObjectCandidate& candidate, std::size_t most, std::vector<ObjectCandidate>& best) const;

    ObjectTemplatesConfig config_;
    Eigen::Vector3f centre_o_m_ = Eigen::Vector3f::Zero();
    std::vector<Template> templates_;
};

}  // namespace touchstone
