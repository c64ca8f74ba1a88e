#include "platform/openni2_drivers/simulator/mesh_source.hpp"

#include <cmath>
#include <optional>

#include "platform/openni2_drivers/simulator/camera_path.hpp"
#include "platform/openni2_drivers/simulator/depth_noise.hpp"
#include "platform/openni2_drivers/simulator/pose_writer.hpp"
#include "platform/openni2_drivers/simulator/rasteriser.hpp"
#include "platform/openni2_drivers/simulator/table_view.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

using namespace sim;

struct MeshSource::State {
    explicit State(const SimulatorConfig& given)
        : config(given),
          mesh(truth_mesh(given)),
          path(config.motion, config.scene == SimulatedScene::room ? room_viewpoint() : wall_viewpoint(),
               config.seed),
          info{kinect_intrinsics(),           true,           kinect_intrinsics().width_px,
               kinect_intrinsics().height_px, config.rate_hz, Pace::live},
          noise(config.seed, info.intrinsics.fx_px, config.noise, config.drift) {
        if (!config.poses_path.empty()) poses.emplace(config.poses_path);
    }

    SimulatorConfig config;
    TriangleMesh mesh;
    CameraPath path;
    SourceInfo info;
    DepthNoise noise;
    std::optional<PoseWriter> poses;
    Raster raster;
    bool color = false;
    int next_index = 0;
};

MeshSource::MeshSource(const SimulatorConfig& config) : state_(std::make_unique<State>(config)) {}

MeshSource::~MeshSource() = default;

const SourceInfo& MeshSource::info() const { return state_->info; }

void MeshSource::enable_color(bool enabled) { state_->color = enabled; }

bool MeshSource::next(SourceFrame& frame) {
    State& state = *state_;
    if (state.config.frames > 0 && state.next_index >= state.config.frames) return false;
    frame.index = state.next_index++;
    const double time_s = frame.index / state.config.rate_hz;
    frame.timestamp_us = static_cast<std::uint64_t>(std::llround(1e6 * time_s));
    const Eigen::Isometry3d T_s_c = state.path.at(frame.index);
    rasterise(state.mesh, T_s_c.inverse(), state.info.intrinsics, state.raster);
    state.noise.apply(state.raster.depth_m, frame.index, time_s, frame.depth_mm);
    frame.color_rgb.clear();
    if (state.color) shade_raster(state.raster, state.mesh, T_s_c, state.info.intrinsics, frame.color_rgb);
    if (state.poses) state.poses->add_frame(time_s, T_s_c);
    return true;
}

TriangleMesh truth_mesh(const SimulatorConfig& config) {
    if (config.scene == SimulatedScene::room) return make_room(config.seed);
    if (config.scene == SimulatedScene::wall) return make_wall();
    throw Error(ExitStatus::usage, "simulator: a table has no triangles; use room or wall");
}

}  // namespace touchstone
