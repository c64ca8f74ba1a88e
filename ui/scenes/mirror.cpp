#include "ui/scenes/mirror.hpp"

#include <utility>

#include "ui/table_frame.hpp"

namespace touchstone {

namespace {

/// Sees what is up to 50 cm beside the model from a lamp at 90 cm.
constexpr Intrinsics lamp_intrinsics{460.f, 460.f, 255.5f, 255.5f, 512, 512, {0, 0}};
constexpr float same_pose = 1e-6f;  // relative: a camera at rest has the very same pose in each frame

}  // namespace

MirrorScene::MirrorScene(const SceneSetup& setup)
    : model_(setup.model ? setup.model : std::make_shared<const MeshModel>(make_vase())) {
    Button reset;
    reset.icon = Icon::undo;
    tools_.set({reset});
}

void MirrorScene::start(PixelSize view) {
    view_ = view;
    things_.reset();
    gestures_.reset();
    rasteriser_.reset();
    from_light_.reset();
    mesh_ = nullptr;
    picture_.forget();
}

void MirrorScene::open(const TableFrame& frame) {
    things_.emplace(frame);
    GestureConfig config;
    config.mm_per_px = surface_.mm_per_px(surface_.room().box_px().center());
    gestures_.emplace(config, [this](const Eigen::Vector2f& px) { return things_->hit(surface_, px); });
    rasteriser_.emplace(*model_, frame.intrinsics);
    from_light_.emplace(*model_, lamp_intrinsics);
}

void MirrorScene::show(const TableFrame& frame) {
    now_us_ = frame.timestamp_us;
    surface_ = SurfaceGeometry(frame, view_);
    if (frame.state != "live" || !frame.has_area) return;
    if (!things_)
        open(frame);
    else if (!T_g_c_.isApprox(frame.T_g_c, same_pose))
        changed();
    T_g_c_ = frame.T_g_c;
    if (std::exchange(over_camera_, frame.view_is_camera) != frame.view_is_camera) picture_.change();
    picture_.show(frame);
}

void MirrorScene::on_touch(const TouchEvent& event) {
    if (tools_.on_touch(event) || !things_) return;
    gestures_->on_touch(event, now_us_);
    things_->on_touch(event, surface_);
}

void MirrorScene::changed() {
    picture_.change();
    mesh_is_old_ = true;
}

void MirrorScene::update(float dt_s) {
    picture_.pass_time(dt_s);
    const bool resets = !tools_.update(now_us_).empty();
    if (!things_) return;
    if (resets) things_->reset();
    for (const Gesture& gesture : gestures_->update(now_us_)) things_->on_gesture(gesture);
    if (things_->update()) changed();
    if (!mesh_is_old_) return;
    const float size_m = things_->size_m(TableThings::model);
    mesh_ = rasteriser_->draw(T_g_c_.inverse() * things_->T_g_m(), size_m);
    mesh_from_light_ = from_light_->draw(things_->T_g_l().inverse() * things_->T_g_m(), size_m);
    mesh_is_old_ = false;
}

SceneWish MirrorScene::wish() const {
    SceneWish wish;
    if (!things_) return wish;
    wish.view = picture_.wish();
    if (over_camera_) wish.view->style = ViewStyle::over_camera;
    wish.view->sphere =
        MirrorSphere{things_->middle_g_m(TableThings::ball), 0.5f * things_->size_m(TableThings::ball)};
    wish.view->mesh = mesh_;
    wish.view->mesh_from_light = mesh_from_light_;
    wish.view->T_g_l = things_->T_g_l();
    return wish;
}

void MirrorScene::draw(Canvas& canvas, const ViewMapping& view) {
    tools_.lay_out(canvas, view, surface_);
    tools_.draw(canvas, view);
}

}  // namespace touchstone
