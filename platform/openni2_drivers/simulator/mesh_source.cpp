#include "platform/openni2_drivers/simulator/mesh_source.hpp"

#include <cmath>
#include <optional>

#include "platform/openni2_drivers/simulator/depth_noise.hpp"
#include "platform/openni2_drivers/simulator/mask_files.hpp"
#include "platform/openni2_drivers/simulator/object_mesh.hpp"
#include "platform/openni2_drivers/simulator/pose_writer.hpp"
#include "platform/openni2_drivers/simulator/room.hpp"
#include "platform/openni2_drivers/simulator/scene_view.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

using namespace sim;

struct MeshSource::State {
    explicit State(const SimulatorConfig& given)
        : config(given),
          view(config.scene == SimulatedScene::object ? make_object_view(config) : make_moving_view(config)),
          info{kinect_intrinsics(),           true,           kinect_intrinsics().width_px,
               kinect_intrinsics().height_px, config.rate_hz, Pace::live},
          noise(config.seed, info.intrinsics.fx_px, config.noise, config.drift) {
        if (!config.poses_path.empty()) poses.emplace(config.poses_path);
    }

    SimulatorConfig config;
    std::unique_ptr<SceneView> view;
    SourceInfo info;
    DepthNoise noise;
    std::optional<PoseWriter> poses;
    Picture picture;
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
    const Eigen::Isometry3d T_s_c = state.view->draw(frame.index, state.picture);
    state.noise.apply(state.picture.depth_m, frame.index, time_s, frame.depth_mm);
    frame.color_rgb.clear();
    if (state.color) state.view->color(state.picture, frame.color_rgb);
    if (state.poses) state.poses->add_frame(time_s, T_s_c);
    if (!state.config.masks_folder.empty())
        write_masks(state.config.masks_folder, frame, state.picture, state.info.intrinsics);
    return true;
}

TriangleMesh truth_mesh(const SimulatorConfig& config) {
    if (config.scene == SimulatedScene::room) return make_room(config.seed);
    if (config.scene == SimulatedScene::wall) return make_wall();
    if (config.scene != SimulatedScene::object)
        throw Error(ExitStatus::usage, "simulator: a table has no triangles; use room, wall or object");
    TriangleMesh mesh = config.mesh_path.empty() ? make_bowl() : read_mesh(config.mesh_path);
    fit(mesh, config.size_m);
    return mesh;
}

}  // namespace touchstone
