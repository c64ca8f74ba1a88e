#include <algorithm>
#include <optional>

#include "platform/openni2_drivers/simulator/camera_path.hpp"
#include "platform/openni2_drivers/simulator/knock.hpp"
#include "platform/openni2_drivers/simulator/mesh_source.hpp"
#include "platform/openni2_drivers/simulator/person.hpp"
#include "platform/openni2_drivers/simulator/rasteriser.hpp"
#include "platform/openni2_drivers/simulator/scene_view.hpp"

namespace touchstone::sim {
namespace {

TableView view_from(const Eigen::Isometry3d& T_s_c) {
    return {kinect_intrinsics(), T_s_c.linear().cast<float>(), T_s_c.translation().cast<float>()};
}

/// Moments of the path with what the camera sees of the scene then.
struct Moment {
    int frame = 0;
    std::vector<float> depth_m;
};

/// Mean share of the pixels that somebody covers who walks so far away: furniture may hide them.
double covered_share(const CameraPath& path, const std::vector<Moment>& moments, double distance_m,
                     std::uint64_t seed) {
    const Person person(path, distance_m, 0, seed);
    Picture picture;
    double covered = 0.0, pixels = 0.0;
    for (const Moment& moment : moments) {
        clear_picture(picture, moment.depth_m);
        draw_hand(picture, person.at(moment.frame), 0, view_from(path.at(moment.frame)));
        covered +=
            static_cast<double>(std::ranges::count_if(picture.part, [](auto part) { return part != 0; }));
        pixels += static_cast<double>(picture.part.size());
    }
    return covered / pixels;
}

/// How far away somebody walks who covers a share of the pixels, in the mean over the first ten seconds.
double distance_for_share(const CameraPath& path, const TriangleMesh& mesh, const SimulatorConfig& config) {
    std::vector<Moment> moments;
    Raster raster;
    for (int frame = 0; frame < 300; frame += 30) {
        rasterise(mesh, path.at(frame).inverse(), kinect_intrinsics(), raster);
        moments.push_back({frame, raster.depth_m});
    }
    double near_m = 0.5, far_m = 2.5;
    for (int step = 0; step < 6; ++step) {
        const double middle_m = 0.5 * (near_m + far_m);
        (covered_share(path, moments, middle_m, config.seed) > config.person ? near_m : far_m) = middle_m;
    }
    return 0.5 * (near_m + far_m);
}

class MovingView : public SceneView {
  public:
    explicit MovingView(const SimulatorConfig& config)
        : config_(config),
          mesh_(truth_mesh(config)),
          path_(config.motion, config.scene == SimulatedScene::room ? room_viewpoint() : wall_viewpoint(),
                config.seed) {
        if (config.person > 0.0)
            person_.emplace(path_, distance_for_share(path_, mesh_, config),
                            static_cast<int>(config.person_s * config.rate_hz), config.seed);
    }

    Eigen::Isometry3d draw(int frame, Picture& picture) override {
        T_s_c_ = path_.at(frame) * knock(config_, frame / config_.rate_hz);
        rasterise(mesh_, T_s_c_.inverse(), kinect_intrinsics(), raster_);
        clear_picture(picture, raster_.depth_m);
        if (person_) {
            body_ = person_->at(frame);
            draw_hand(picture, body_, 0, view_from(T_s_c_));
        }
        return T_s_c_;
    }

    void color(const Picture& picture, std::vector<std::uint8_t>& color_rgb) override {
        shade_raster(raster_, mesh_, T_s_c_, Eigen::Matrix3d::Identity(), kinect_intrinsics(), color_rgb);
        if (person_) color_hand(color_rgb, picture, body_, person_->shape(), 0, view_from(T_s_c_));
    }

  private:
    SimulatorConfig config_;
    TriangleMesh mesh_;
    CameraPath path_;
    std::optional<Person> person_;
    Hand body_;  ///< of this frame
    Raster raster_;
    Eigen::Isometry3d T_s_c_ = Eigen::Isometry3d::Identity();
};

}  // namespace

std::unique_ptr<SceneView> make_moving_view(const SimulatorConfig& config) {
    return std::make_unique<MovingView>(config);
}

}  // namespace touchstone::sim
