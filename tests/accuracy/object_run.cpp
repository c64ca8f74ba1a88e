#include "tests/accuracy/object_run.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <unistd.h>

#include "pipeline/surface_mesh.hpp"
#include "platform/openni2_drivers/simulator/placed_object.hpp"
#include "platform/openni2_drivers/simulator/simulator_source.hpp"
#include "platform/openni2_drivers/simulator/static_layer.hpp"

namespace touchstone {

namespace {

double resident_megabytes() {
    std::ifstream statm("/proc/self/statm");
    double all = 0.0, resident = 0.0;
    statm >> all >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// The scene that a sensor URI makes, with its truth.
struct Stage {
    explicit Stage(const std::string& uri)
        : config(parse_simulator_uri(uri)),
          view(sim::make_table_view(config.height_m, config.tilt_deg)),
          scene(sim::make_scene(config.scene, config.seed, view.on_table(639.0F, 239.5F).x())),
          depth_m(sim::render_static_depth(scene, view)) {
        if (config.object != ObjectKind::none) placed.emplace(config, scene, view);
    }
    /// The pixels of the thing at rest.
    std::vector<std::size_t> covered() const {
        sim::Picture picture;
        sim::clear_picture(picture, depth_m);
        sim::draw_shape(picture, placed->resting(), view);
        std::vector<std::size_t> pixels;
        for (std::size_t i = 0; i < depth_m.size(); ++i)
            if (picture.depth_m[i] < depth_m[i]) pixels.push_back(i);
        return pixels;
    }

    SimulatorConfig config;
    sim::TableView view;
    sim::Scene scene;
    std::vector<float> depth_m;  ///< of the table without the thing
    std::optional<sim::PlacedObject> placed;
};

std::vector<float> predicted_m(const InteractionPipeline& pipeline) {
    const SurfacePrediction& prediction = pipeline.background()->prediction();
    const std::vector<float> map = prediction.depth_m.read();
    std::vector<float> picture;
    for (int y = 0; y < prediction.shape.height_px; ++y)
        for (int x = 0; x < prediction.shape.width_px; ++x)
            picture.push_back(map[map_index(prediction.shape, x, y)]);
    return picture;
}

/// Runs a source through a pipeline, a frame at a time.
class Run {
  public:
    Run(const Device& device, const InteractionConfig& config, const std::string& uri)
        : source_(parse_simulator_uri(uri)), pipeline(device, config, source_.info().intrinsics) {}
    InteractionFrame next() {
        source_.next(picture_);
        time_s = 1e-6 * static_cast<double>(picture_.timestamp_us);
        return pipeline.process({picture_.depth_mm, source_.info().intrinsics}, picture_.timestamp_us);
    }

  private:
    SimulatorSource source_;
    SourceFrame picture_;

  public:
    InteractionPipeline pipeline;
    double time_s = 0.0;
};

struct Cycle {
    double put_s = 1.5, take_s = 5.0, length_s = 6.6;
};

Eigen::Vector3f scene_point(const sim::TableView& view, const RigidTransform& T_g_c,
                            const Eigen::Vector3f& p_g) {
    return view.to_scene(T_g_c.inverse() * p_g);
}

int ghost_vertices(const Stage& stage, const InteractionPipeline& pipeline) {
    const SurfaceMesh mesh = extract_surface(take_snapshot(pipeline.background()->volume()), {1, 0});
    const sim::Shape& shape = stage.placed->resting();
    int ghosts = 0;
    for (const Eigen::Vector3f& vertex_g : mesh.vertices_g_m) {
        const Eigen::Vector3f p_s = scene_point(stage.view, pipeline.background()->T_g_c(), vertex_g);
        ghosts += shape.distance(p_s) < 0.01F && stage.scene.distance(p_s) > 0.015F;
    }
    return ghosts;
}

void compare_with_before(const Stage& stage, const InteractionPipeline& pipeline,
                         const std::vector<float>& before_m, PutAndTakeScore& score) {
    score.bricks_after = pipeline.background()->volume().bricks_in_use();
    const std::vector<float> after_m = predicted_m(pipeline);
    for (const std::size_t i : stage.covered())
        score.ghost_mm =
            std::max(score.ghost_mm, 1000.0 * std::abs(static_cast<double>(after_m[i] - before_m[i])));
    score.ghost_vertices = ghost_vertices(stage, pipeline);
    const StageSummary summary = pipeline.stage_times().summary("object segmentation");
    score.stage_ms = summary.median_ms;
    score.stage_p99_ms = summary.p99_ms;
}

}  // namespace

PutAndTakeScore run_put_and_take(const Device& device, const std::string& scene, int seed, int cycles) {
    const Cycle cycle;
    const std::string uri = fmt::format("{}?seed={}&hands=0&object=box&put_s={}&take_s={}&cycle_s={}", scene,
                                        seed, cycle.put_s, cycle.take_s, cycle.length_s);
    const Stage stage(uri);
    InteractionConfig config;
    config.background.objects.settle_s = 1.0f;
    // The first cycle's hand comes when the scan is done.
    config.scan_frames = 8;
    Run run(device, config, uri);
    PutAndTakeScore score;
    std::vector<float> before_m;
    int now = 0;
    const double left_s = cycle.put_s + sim::PlacedObject::hold_s + sim::PlacedObject::visit_s;
    while (score.cycles < cycles) {
        const InteractionFrame frame = run.next();
        const double in_cycle_s = std::fmod(run.time_s, cycle.length_s);
        if (frame.state == InteractionState::live && before_m.empty()) {
            before_m = predicted_m(run.pipeline);
            score.bricks_before = run.pipeline.background()->volume().bricks_in_use();
        }
        if (frame.objects.settled > 0) score.settle_s += in_cycle_s - left_s;
        if (frame.objects.taken > 0) score.back_s = std::max(score.back_s, in_cycle_s - cycle.take_s);
        score.settled += frame.objects.settled;
        score.taken += frame.objects.taken;
        score.lifted += static_cast<int>(frame.objects.lifted.size());
        const int done = static_cast<int>(run.time_s / cycle.length_s + 1e-9);
        if (done == now) continue;
        now = score.cycles = done;
        if (done == std::min(5, cycles)) score.megabytes_first = resident_megabytes();
        score.megabytes_last = resident_megabytes();
    }
    score.settle_s /= std::max(1, score.settled);
    compare_with_before(stage, run.pipeline, before_m, score);
    return score;
}

namespace {

bool is_inside_surface(std::int32_t voxel) {
    return (voxel >> 16 & 0xff) > 0 && static_cast<std::int16_t>(voxel & 0xffff) <= 0;
}

/// Calls what(brick index in the snapshot, voxel, centre in g).
template <class What>
void for_each_voxel(const VolumeSnapshot& snapshot, What what) {
    const int side = snapshot.config.size_vox / BRICK_VOX;
    const float voxel_m = snapshot.config.side_m / static_cast<float>(snapshot.config.size_vox);
    for (std::size_t i = 0; i < snapshot.bricks.size(); ++i) {
        const int brick = snapshot.bricks[i];
        const Eigen::Vector3i corner(brick % side, brick / side % side, brick / side / side);
        for (int voxel = 0; voxel < BRICK_VOXELS; ++voxel) {
            const Eigen::Vector3i at =
                corner * BRICK_VOX + Eigen::Vector3i(voxel & 7, voxel >> 3 & 7, voxel >> 6);
            const Eigen::Vector3f center_g_m = (at.cast<float>().array() + 0.5f).matrix() * voxel_m;
            what(i, voxel, center_g_m);
        }
    }
}

double voxel_iou(const Stage& stage, const VolumeSnapshot& scan, const VolumeSnapshot& object,
                 const RigidTransform& T_g_c) {
    int both = 0, either = 0;
    for_each_voxel(scan, [&](std::size_t i, int voxel, const Eigen::Vector3f& center_g_m) {
        const auto within = static_cast<std::size_t>(voxel);
        if (!is_inside_surface(scan.voxels[i * BRICK_VOXELS + within])) return;
        const auto found = std::ranges::lower_bound(object.bricks, scan.bricks[i]);
        const auto at = static_cast<std::size_t>(found - object.bricks.begin());
        const bool taken = found != object.bricks.end() && *found == scan.bricks[i] &&
                           is_inside_surface(object.voxels[at * BRICK_VOXELS + within]);
        const bool is = stage.placed->resting().distance(scene_point(stage.view, T_g_c, center_g_m)) <= 0.0F;
        both += taken && is;
        either += taken || is;
    });
    return either > 0 ? static_cast<double>(both) / either : 0.0;
}

}  // namespace

LiftScore run_lift(const Device& device, const std::string& scene, int seed, const std::string& object) {
    constexpr double take_s = 3.5;
    const std::string uri =
        fmt::format("{}?seed={}&hands=0&object={}&take_s={}&frames=300", scene, seed, object, take_s);
    const Stage stage(uri);
    Run run(device, InteractionConfig{}, uri);
    LiftScore score;
    VolumeSnapshot scan, model;
    const double away_s = take_s + sim::PlacedObject::hold_s + sim::PlacedObject::visit_s;
    for (int i = 0; i < 240; ++i) {
        const InteractionFrame frame = run.next();
        // Before the hand comes.
        if (scan.bricks.empty() && run.time_s >= take_s - sim::PlacedObject::visit_s)
            scan = take_snapshot(run.pipeline.background()->volume());
        for (const VolumeSnapshot& lifted : frame.objects.lifted) {
            ++score.cuts;
            if (score.lifted) continue;
            score.lifted = true;
            score.after_s = run.time_s - away_s;
            model = lifted;
        }
    }
    if (!score.lifted) return score;
    const RigidTransform& T_g_c = run.pipeline.background()->T_g_c();
    score.iou = voxel_iou(stage, scan, model, T_g_c);
    const SurfaceMesh mesh = extract_surface(model);
    for (const Eigen::Vector3f& vertex : mesh.vertices_g_m)
        score.surface_mm += 1000.0 * std::abs(static_cast<double>(stage.placed->resting().distance(
                                         scene_point(stage.view, T_g_c, vertex))));
    score.surface_mm /= std::max<double>(1.0, static_cast<double>(mesh.vertices_g_m.size()));
    const std::vector<float> now_m = predicted_m(run.pipeline);
    int seen = 0;
    for (const std::size_t i : stage.covered()) {
        if (now_m[i] <= 0.0f) continue;
        score.rest_mm += 1000.0 * std::abs(static_cast<double>(now_m[i] - stage.depth_m[i]));
        ++seen;
    }
    score.rest_mm /= std::max(1, seen);
    return score;
}

MoverScore run_scan_with_mover(const Device& device, const std::string& scene, int seed, int hands) {
    const std::string uri = fmt::format("{}?seed={}&hands={}&empty=0&frames=400", scene, seed, hands);
    const Stage stage(uri);
    Run run(device, InteractionConfig{}, uri);
    // The hands are at work when the camera is switched on: the first second is not shown.
    SimulatorSource source(parse_simulator_uri(uri));
    SourceFrame picture;
    for (int i = 0; i < 45; ++i) source.next(picture);
    MoverScore score;
    for (int i = 0; i < 355; ++i) {
        source.next(picture);
        const InteractionFrame frame =
            run.pipeline.process({picture.depth_mm, source.info().intrinsics}, picture.timestamp_us);
        if (frame.state != InteractionState::scanning || frame.scan_progress < 1.0f) continue;
        score.live_after_frames = i + 1;
        break;
    }
    const std::vector<float> now_m = predicted_m(run.pipeline);
    int wrong = 0, unknown = 0;
    for (std::size_t i = 0; i < now_m.size(); ++i) {
        unknown += now_m[i] <= 0.0f;
        wrong += now_m[i] > 0.0f && now_m[i] < stage.depth_m[i] - 0.015f;
    }
    score.wrong_share = static_cast<double>(wrong) / static_cast<double>(now_m.size());
    score.unknown_share = static_cast<double>(unknown) / static_cast<double>(now_m.size());
    return score;
}

}  // namespace touchstone
