#include "app/projector_mapping.hpp"

#include <algorithm>

namespace touchstone {
namespace {

constexpr int grid_step_px = 4;
constexpr int frames_between_looks = 30;  // things are put down and taken away
constexpr float least_change_m = 0.003f;
constexpr float least_knock_m = 0.002f;

bool has_changed(const SurfaceGrid& before, const SurfaceGrid& now) {
    return !std::ranges::equal(before.points_g_m, now.points_g_m,
                               [](const Eigen::Vector4f& a, const Eigen::Vector4f& b) {
                                   return (a - b).cwiseAbs().maxCoeff() < least_change_m;
                               });
}

}  // namespace

SurfaceGrid make_surface_grid(const SurfacePrediction& prediction, const Intrinsics& intrinsics,
                              const RigidTransform& T_g_c, int step_px) {
    const std::vector<float> depth_m = without_padding(prediction.depth_m, prediction.shape);
    const int width_px = prediction.shape.width_px, height_px = prediction.shape.height_px;
    SurfaceGrid grid;
    grid.step_px = step_px;
    grid.width = (width_px + step_px - 1) / step_px;
    grid.height = (height_px + step_px - 1) / step_px;
    for (int y = 0; y < height_px; y += step_px) {
        for (int x = 0; x < width_px; x += step_px) {
            Eigen::Vector4f& point = grid.points_g_m.emplace_back(Eigen::Vector4f::Zero());
            const float depth = depth_m[static_cast<std::size_t>(y * width_px + x)];
            if (depth <= 0.0f) continue;
            const Eigen::Vector3f point_c_m = back_project(intrinsics, x, y, depth);
            const Eigen::Vector3f point_g_m = T_g_c * point_c_m;
            point = {point_g_m.x(), point_g_m.y(), point_g_m.z(), 1.0f};
        }
    }
    return grid;
}

void ProjectorMapping::follow(InteractionState state, const BackgroundModel* background,
                              const Intrinsics& intrinsics) {
    is_new_scan_ = is_new_scan_ || state == InteractionState::scanning;
    if (state != InteractionState::live || !background) return;
    const RigidTransform& T_g_c = background->T_g_c();
    if (is_new_scan_ || !T_g_c.isApprox(T_g_c_, 1e-7f)) place(T_g_c);
    if (!surface_ || frames_++ % frames_between_looks == 0) refresh_surface(*background, intrinsics);
}

void ProjectorMapping::place(const RigidTransform& T_g_c) {
    const bool was_placed = model_ != nullptr;
    const bool was_knocked =
        was_placed && !is_new_scan_ && (T_g_c.translation() - T_g_c_.translation()).norm() > least_knock_m;
    T_g_c_ = T_g_c;
    if (!was_placed || is_new_scan_ || moves_with_camera_)
        model_ = std::make_shared<ProjectorModel>(in_other_frame(from_camera_, T_g_c));
    else
        from_camera_ = in_other_frame(*model_, T_g_c.inverse(Eigen::Isometry));
    surface_ = nullptr;
    const bool is_doubtful = !moves_with_camera_ && (is_new_scan_ || was_knocked);
    if (!was_placed || is_doubtful) ++doubts_;
    if (moves_with_camera_)
        note_.clear();
    else if (was_placed && is_new_scan_)
        note_ =
            "The table was scanned anew: does the projector's picture still lie right? Else calibrate again.";
    else if (was_knocked)
        note_ = "The camera was moved: does the projector's picture still lie right? Else calibrate again.";
    is_new_scan_ = false;
}

void ProjectorMapping::refresh_surface(const BackgroundModel& background, const Intrinsics& intrinsics) {
    SurfaceGrid grid =
        make_surface_grid(background.prediction(), intrinsics, background.T_g_c(), grid_step_px);
    if (surface_ && !has_changed(*surface_, grid)) return;
    grid.version = ++versions_;
    surface_ = std::make_shared<SurfaceGrid>(std::move(grid));
}

}  // namespace touchstone
