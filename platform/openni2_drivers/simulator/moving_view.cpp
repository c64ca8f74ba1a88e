#include "platform/openni2_drivers/simulator/camera_path.hpp"
#include "platform/openni2_drivers/simulator/knock.hpp"
#include "platform/openni2_drivers/simulator/mesh_source.hpp"
#include "platform/openni2_drivers/simulator/rasteriser.hpp"
#include "platform/openni2_drivers/simulator/scene_view.hpp"

namespace touchstone::sim {
namespace {

class MovingView : public SceneView {
  public:
    explicit MovingView(const SimulatorConfig& config)
        : config_(config),
          mesh_(truth_mesh(config)),
          path_(config.motion, config.scene == SimulatedScene::room ? room_viewpoint() : wall_viewpoint(),
                config.seed) {}

    Eigen::Isometry3d draw(int frame, Picture& picture) override {
        T_s_c_ = path_.at(frame) * knock(config_, frame / config_.rate_hz);
        rasterise(mesh_, T_s_c_.inverse(), kinect_intrinsics(), raster_);
        clear_picture(picture, raster_.depth_m);
        return T_s_c_;
    }

    void color(const Picture&, std::vector<std::uint8_t>& color_rgb) override {
        shade_raster(raster_, mesh_, T_s_c_, Eigen::Matrix3d::Identity(), kinect_intrinsics(), color_rgb);
    }

  private:
    SimulatorConfig config_;
    TriangleMesh mesh_;
    CameraPath path_;
    Raster raster_;
    Eigen::Isometry3d T_s_c_ = Eigen::Isometry3d::Identity();
};

}  // namespace

std::unique_ptr<SceneView> make_moving_view(const SimulatorConfig& config) {
    return std::make_unique<MovingView>(config);
}

}  // namespace touchstone::sim
