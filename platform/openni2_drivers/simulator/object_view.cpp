#include <algorithm>
#include <optional>

#include "platform/openni2_drivers/simulator/holding_hands.hpp"
#include "platform/openni2_drivers/simulator/knock.hpp"
#include "platform/openni2_drivers/simulator/mesh_source.hpp"
#include "platform/openni2_drivers/simulator/rasteriser.hpp"
#include "platform/openni2_drivers/simulator/room.hpp"
#include "platform/openni2_drivers/simulator/scene_view.hpp"

namespace touchstone::sim {
namespace {

TriangleMesh wall_behind() {
    constexpr float away_m = 1.8F;
    TriangleMesh wall = make_wall();
    for (Vec3& vertex : wall.vertices) vertex.y() += away_m;
    return wall;
}

/// Frame w of TurnedObject takes the place of the tables' scene frame.
TableView view_from(const Eigen::Isometry3d& T_w_c) {
    return {kinect_intrinsics(), T_w_c.linear().cast<float>(), T_w_c.translation().cast<float>()};
}

class ObjectView : public SceneView {
  public:
    explicit ObjectView(const SimulatorConfig& config)
        : config_(config), mesh_(truth_mesh(config)), turned_(config.seed), wall_(wall_behind()) {
        if (config.fingers) hands_.emplace(mesh_, turned_, config.seed);
    }

    Eigen::Isometry3d draw(int frame, Picture& picture) override {
        const int time = TurnedObject::folded(frame);
        T_w_c_ = look_at({0.0, TurnedObject::distance_m - config_.distance_m, 0.0}, {0.0, 2.0, 0.0}) *
                 knock(config_, frame / config_.rate_hz);
        T_w_o_ = turned_.at(time);
        rasterise(wall_, T_w_c_.inverse(), kinect_intrinsics(), wall_raster_);
        rasterise(mesh_, T_w_c_.inverse() * T_w_o_, kinect_intrinsics(), raster_);
        clear_picture(picture, wall_raster_.depth_m);
        for (std::size_t i = 0; i < picture.depth_m.size(); ++i)
            picture.depth_m[i] = std::min(picture.depth_m[i], raster_.depth_m[i]);
        held_.clear();
        for (int hand = 0; hands_ && hand < 2; ++hand) {
            held_.push_back(hands_->at(hand, time));
            draw_hand(picture, held_.back(), hand, view_from(T_w_c_));
        }
        return T_w_o_.inverse() * T_w_c_;
    }

    void color(const Picture& picture, std::vector<std::uint8_t>& color_rgb) override {
        const Intrinsics intrinsics = kinect_intrinsics();
        shade_raster(wall_raster_, wall_, T_w_c_, Eigen::Matrix3d::Identity(), intrinsics, color_rgb);
        shade_raster(raster_, mesh_, T_w_o_.inverse() * T_w_c_, T_w_o_.linear(), intrinsics, color_rgb);
        for (std::size_t hand = 0; hand < held_.size(); ++hand)
            color_hand(color_rgb, picture, held_[hand], hands_->shape(static_cast<int>(hand)),
                       static_cast<int>(hand), view_from(T_w_c_));
    }

  private:
    SimulatorConfig config_;
    TriangleMesh mesh_;
    TurnedObject turned_;
    TriangleMesh wall_;
    std::optional<HoldingHands> hands_;
    std::vector<Hand> held_;  ///< of this frame
    Raster wall_raster_, raster_;
    Eigen::Isometry3d T_w_c_ = Eigen::Isometry3d::Identity();
    Eigen::Isometry3d T_w_o_ = Eigen::Isometry3d::Identity();
};

}  // namespace

std::unique_ptr<SceneView> make_object_view(const SimulatorConfig& config) {
    return std::make_unique<ObjectView>(config);
}

}  // namespace touchstone::sim
