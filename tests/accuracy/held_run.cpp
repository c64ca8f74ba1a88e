#include "tests/accuracy/held_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "pipeline/column_drift.hpp"
#include "pipeline/depth_map_conversion.hpp"
#include "pipeline/foreground_segmentation.hpp"
#include "pipeline/reconstruction.hpp"
#include "platform/openni2_drivers/simulator/mesh_source.hpp"
#include "platform/system/percentile.hpp"
#include "tests/accuracy/path_score.hpp"
#include "tests/accuracy/surface_score.hpp"
#include "tests/accuracy/true_surface.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {

namespace {

constexpr float cube_side_m = 0.32f;
constexpr double wall_behind_m = 1.05;  // the object
constexpr double astray_mm = 30.0, astray_deg = 15.0;

SimulatorConfig simulation(const HeldRun& run) {
    SimulatorConfig config;
    config.scene = SimulatedScene::object;
    config.seed = static_cast<std::uint64_t>(run.seed);
    config.mesh_path = run.mesh.string();
    return config;
}

/// The live loop before a wall: conversion, drift, mask, the object.
class Desk {
  public:
    Desk(const Device& device, const Intrinsics& k, float wall_m, const VolumeSnapshot& model)
        : device_(&device),
          k_(k),
          conversion_(device, {}, k),
          live_(device, make_map_shape(k)),
          wall_(device, live_.shape),
          segmentation_(device, {}, k),
          drift_(device, {}, k),
          object_(device, {}, k, model) {
        wall_.depth_m.fill(wall_m);
        wall_.normals_c.fill(0.0f);
    }

    HeldObjectFrame process(const std::vector<std::uint16_t>& depth_mm, double& took_ms) {
        conversion_.convert({depth_mm, k_}, live_);
        const Foreground& foreground = segmentation_.segment(live_, wall_);
        segmentation_.mask_background(live_, wall_);
        conversion_.set_column_shift(drift_.update(live_, wall_, foreground));
        device_->finish();
        const auto start = std::chrono::steady_clock::now();
        const HeldObjectFrame frame = object_.process(live_, foreground.mask);
        took_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        return frame;
    }

  private:
    const Device* device_;
    Intrinsics k_;
    DepthMapConversion conversion_;
    LiveMaps live_;
    SurfacePrediction wall_;
    ForegroundSegmentation segmentation_;
    ColumnDrift drift_;
    HeldObject object_;
};

/// Books what each frame says.
class Ledger {
  public:
    void add(const HeldObjectFrame& frame, bool in_view) {
        const bool tracked = frame.state == HeldObjectState::tracked;
        score.frames += in_view;
        score.tracked += in_view && tracked;
        score.unseen += !in_view && tracked && ++frames_away_ > 10;
        if (in_view) frames_away_ = 0;
        score.found += tracked && !was_tracked_;
        score.lost += !tracked && was_tracked_;
        if (!tracked && was_tracked_) score.reasons.push_back(frame.reason);
        searched_ = in_view && !tracked ? searched_ + 1 : 0;
        score.longest_search = std::max(score.longest_search, searched_);
        was_tracked_ = tracked;
    }
    void add_error(const RigidTransform& T_c_m, const RigidTransform& T_true) {
        const double mm = 1000.0 * static_cast<double>((T_c_m.translation() - T_true.translation()).norm());
        const Eigen::AngleAxisf turn(Eigen::Matrix3f(T_c_m.linear().transpose() * T_true.linear()));
        const double deg = std::abs(static_cast<double>(turn.angle())) * 180.0 / std::numbers::pi;
        score.astray += mm > astray_mm || deg > astray_deg;
        score.largest_mm = std::max(score.largest_mm, mm);
        score.largest_deg = std::max(score.largest_deg, deg);
        squares_mm_ += mm * mm;
        squares_deg_ += deg * deg;
        ++errors_;
        score.rms_mm = std::sqrt(squares_mm_ / errors_);
        score.rms_deg = std::sqrt(squares_deg_ / errors_);
    }
    HeldScore score;

  private:
    bool was_tracked_ = false;
    int searched_ = 0, frames_away_ = 0, errors_ = 0;
    double squares_mm_ = 0.0, squares_deg_ = 0.0;
};

}  // namespace

ScannedObject scan_object(const Device& device, const HeldRun& run) {
    const TemporaryFolder folder;
    SimulatorConfig config = simulation(run);
    config.poses_path = (folder / "poses").string();
    config.frames = 1;
    ReconstructionConfig reconstruction_config;
    reconstruction_config.volume.size_vox = 256;
    reconstruction_config.volume.side_m = cube_side_m;
    reconstruction_config.use_color = false;
    RigidTransform T_m_c = RigidTransform::Identity();
    {
        MeshSource first(config);
        SourceFrame frame;
        first.next(frame);
    }
    T_m_c = read_trajectory(config.poses_path).front().T_w_c.cast<float>();
    config.poses_path.clear();
    config.frames = run.scan_frames;
    MeshSource source(config);
    const Intrinsics k = source.info().intrinsics;
    std::optional<Reconstruction> reconstruction;
    RigidTransform T_o_first = RigidTransform::Identity();
    SourceFrame frame;
    while (source.next(frame)) {
        const DepthView view{frame.depth_mm, k};
        if (!reconstruction) {
            T_o_first = *place_camera(view, cube_side_m);
            reconstruction.emplace(device, reconstruction_config, k, T_o_first);
        }
        reconstruction->process(view, {});
    }
    ScannedObject object{take_snapshot(reconstruction->volume()), RigidTransform::Identity(), 0.0};
    const SurfaceMesh mesh = extract_surface(object.volume), truth = surface_of(truth_mesh(config));
    object.T_m_o = align_to_truth(mesh, truth, T_m_c * T_o_first.inverse());
    object.error_mm = score_surface(transformed(mesh, object.T_m_o), truth, 20'000).mean_mm;
    return object;
}

HeldScore run_held(const Device& device, const HeldRun& run, const ScannedObject& object) {
    const TemporaryFolder folder;
    SimulatorConfig config = simulation(run);
    config.fingers = true;
    config.distance_m = run.distance_m;
    config.frames = run.frames;
    config.poses_path = (folder / "poses").string();
    std::vector<HeldObjectFrame> frames;
    std::vector<double> took_ms;
    Ledger ledger;
    const auto is_away = [&](int frame) {
        return frame >= run.away_every && frame % run.away_every < run.away_frames;
    };
    {
        MeshSource source(config);
        const auto wall_m = static_cast<float>(run.distance_m + wall_behind_m);
        const auto wall_mm = static_cast<std::uint16_t>(std::lround(1000.0f * wall_m));
        Desk desk(device, source.info().intrinsics, wall_m, object.volume);
        SourceFrame frame;
        while (source.next(frame)) {
            if (is_away(frame.index)) std::ranges::fill(frame.depth_mm, wall_mm);
            took_ms.push_back(0.0);
            frames.push_back(desk.process(frame.depth_mm, took_ms.back()));
            ledger.add(frames.back(), !is_away(frame.index));
        }
    }
    const std::vector<TimedPose> poses = read_trajectory(config.poses_path);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (frames[i].state != HeldObjectState::tracked || is_away(static_cast<int>(i))) continue;
        ledger.add_error(frames[i].T_c_o * object.T_m_o.inverse(), poses[i].T_w_c.inverse().cast<float>());
    }
    ledger.score.model_mm = object.error_mm;
    ledger.score.slowest_ms = percentile(took_ms, 100.0);
    ledger.score.median_ms = percentile(took_ms, 50.0);
    return ledger.score;
}

}  // namespace touchstone
