#include "ui/scenes/paint.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "platform/system/error.hpp"
#include "platform/system/log.hpp"
#include "ui/painting_file.hpp"
#include "ui/table_frame.hpp"

namespace touchstone {

namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float noticed_shift_px = 0.5f;
constexpr std::uint64_t quiet_us = 1'000'000;  // a save waits for the disk: nobody paints then
constexpr std::uint64_t between_tries_us = 60'000'000;

/// How far the picture of the surface has moved between two poses of the camera.
float shift_px(const SurfaceGeometry& surface, const RigidTransform& drawn_T_g_c, PixelSize view) {
    float most = 0.f;
    const RigidTransform T_now_drawn = surface.T_g_c() * drawn_T_g_c.inverse(Eigen::Isometry);
    for (const float x : {0.f, static_cast<float>(view.width_px)})
        for (const float y : {0.f, static_cast<float>(view.height_px)}) {
            Fingertip corner;
            corner.pixel_px = {x, y};
            const auto before = surface.pixel_px(T_now_drawn * surface.point_g_m(corner));
            if (!before) return INFINITY;
            most = std::max(most, (*before - Vector2f(x, y)).norm());
        }
    return most;
}

}  // namespace

PaintScene::PaintScene(const SceneSetup& setup) : file_(setup.painting_file) {
    is_loaded_ = file_.empty();
    set_tools();
}

PaintScene::~PaintScene() { save(); }

void PaintScene::start(PixelSize view) {
    fingers_.clear();
    const bool is_new_scan = layer_ && view == view_;
    if (!is_new_scan) layer_.emplace(view);
    view_ = view;
    if (is_new_scan) {
        is_saved_ = is_saved_ && !painting_.can_undo();
        painting_ = Painting();
        changed_us_ = now_us_;
    }
    redraw();
}

void PaintScene::show(const TableFrame& frame) {
    now_us_ = frame.timestamp_us;
    saw_scan_ = saw_scan_ || frame.state == "scanning";
    if (frame.state != "live") return;
    surface_ = SurfaceGeometry(frame, view_);
    if (!is_loaded_) load(frame.T_g_c);
    if (layer_ && shift_px(surface_, drawn_T_g_c_, view_) > noticed_shift_px) redraw();
}

void PaintScene::on_touch(const TouchEvent& event) {
    if (!layer_ || tools_.on_touch(event)) return;
    const auto& [tip, phase] = event;
    const auto finger = fingers_.find(tip.id);
    // A touch whose beginning was never told starts where it is first seen.
    if (finger == fingers_.end() || phase == TouchPhase::down) {
        if (finger != fingers_.end()) painting_.finish(finger->second.stroke);
        begin_stroke(tip);
    } else if (const Vector3f point = surface_.point_g_m(tip);
               painting_.extend(finger->second.stroke, point)) {
        pieces_.clear();
        if (const auto at = surface_.pixel_px(point)) finger->second.path.move(*at, pieces_);
        draw_pieces(*painting_.stroke(finger->second.stroke), point);
    }
    is_saved_ = false;
    changed_us_ = now_us_;
    if (phase != TouchPhase::up) return;
    const auto ended = fingers_.find(tip.id);
    painting_.finish(ended->second.stroke);
    if (const Stroke* const stroke = painting_.stroke(ended->second.stroke)) {
        pieces_.clear();
        ended->second.path.finish(pieces_);
        draw_pieces(*stroke, stroke->points_g_m.back());
    }
    fingers_.erase(ended);
}

void PaintScene::begin_stroke(const Fingertip& tip) {
    const Vector3f point = surface_.point_g_m(tip);
    const float width_mm = style::stroke_widths_mm[width_] * (erases_ ? style::eraser_growth : 1.f);
    const int stroke =
        painting_.begin(color_.value_or(style::finger_color(tip.id)), width_mm, erases_, point);
    pieces_.clear();
    fingers_.insert_or_assign(
        tip.id, Finger{stroke, StrokePath(surface_.pixel_px(point).value_or(tip.pixel_px), pieces_)});
    draw_pieces(*painting_.stroke(stroke), point);
}

void PaintScene::draw_pieces(const Stroke& stroke, const Vector3f& at_g_m) {
    layer_->add(pieces_, {stroke.color, 0.5f * surface_.length_px(at_g_m, stroke.width_mm), stroke.erases});
}

/// As the strokes were drawn, point by point, so that it gives the same picture.
void PaintScene::redraw() {
    drawn_T_g_c_ = surface_.T_g_c();
    redraws_done_ = painting_.redraws();
    layer_->clear();
    for (const Stroke* const stroke : painting_.visible()) {
        std::optional<StrokePath> path;
        for (const Vector3f& point : stroke->points_g_m) {
            const auto at = surface_.pixel_px(point);
            if (!at) continue;
            pieces_.clear();
            if (path)
                path->move(*at, pieces_);
            else
                path.emplace(*at, pieces_);
            draw_pieces(*stroke, point);
        }
        const auto finger = std::find_if(fingers_.begin(), fingers_.end(), [&](const auto& each) {
            return painting_.stroke(each.second.stroke) == stroke;
        });
        pieces_.clear();
        if (path && finger != fingers_.end())
            finger->second.path = *path;
        else if (path)
            path->finish(pieces_);
        draw_pieces(*stroke, stroke->points_g_m.back());
    }
}

void PaintScene::update(float) {
    if (!layer_) return;
    for (const int tool : tools_.update(now_us_)) press(tool);
    if (redraws_done_ != painting_.redraws()) redraw();
    layer_->flush();
    save_when_quiet();
}

const GlTexture* PaintScene::surface_layer() const { return layer_ ? &layer_->picture() : nullptr; }

void PaintScene::draw(Canvas& canvas, const ViewMapping& view) {
    set_tools();
    tools_.lay_out(canvas, view, surface_);
    tools_.draw(canvas, view);
}

void PaintScene::press(int tool) {
    using namespace paint_tool;
    if (tool == undo || tool == clear) {
        if (tool == clear) fingers_.clear();
        tool == undo ? static_cast<void>(painting_.undo()) : painting_.clear();
        is_saved_ = false;
        changed_us_ = now_us_;
    } else if (tool == eraser) {
        erases_ = true;
    } else if (tool >= first_width) {
        width_ = static_cast<std::size_t>(tool - first_width);
    } else {
        erases_ = false;
        color_.reset();
        if (tool == white) color_ = style::white;
        if (tool >= first_color && tool < white)
            color_ = style::palette[static_cast<std::size_t>(tool - first_color)];
    }
}

void PaintScene::set_tools() {
    using namespace paint_tool;
    std::vector<Button> buttons;
    const auto add = [&](int id, Icon icon, bool selected, bool gap_before = false) -> Button& {
        Button button;
        button.id = id;
        button.icon = icon;
        button.selected = selected;
        button.gap_before = gap_before;
        return buttons.emplace_back(button);
    };
    add(each_finger, Icon::each_finger, !erases_ && !color_);
    for (std::size_t i = 0; i < style::palette.size(); ++i)
        add(first_color + static_cast<int>(i), Icon::colour, !erases_ && color_ == style::palette[i]).color =
            style::palette[i];
    add(white, Icon::colour, !erases_ && color_ == style::white).color = style::white;
    add(eraser, Icon::eraser, erases_);
    constexpr std::array<float, 3> dots{0.3f, 0.55f, 0.9f};
    for (std::size_t i = 0; i < dots.size(); ++i)
        add(first_width + static_cast<int>(i), Icon::width, width_ == i, i == 0).fill = dots[i];
    add(undo, Icon::undo, false, true).enabled = painting_.can_undo();
    Button& clears = add(clear, Icon::clear, false);
    clears.is_held = true;
    clears.enabled = !painting_.is_empty();
    tools_.set(std::move(buttons));
}

/// A new scan has a frame of its own: the camera is taken to be where it was.
void PaintScene::load(const RigidTransform& T_g_c) {
    is_loaded_ = true;
    try {
        std::optional<StoredPainting> stored = load_painting(file_);
        if (!stored) return;
        painting_ = std::move(stored->painting);
        if (saw_scan_) painting_.move(T_g_c * stored->T_g_c.inverse(Eigen::Isometry));
        if (layer_) redraw();
    } catch (const Error& error) {
        log_warning("{}; the table starts empty", error.what());
    }
}

void PaintScene::save_when_quiet() {
    changed_us_ = std::min(changed_us_, now_us_);
    next_save_us_ = std::min(next_save_us_, now_us_ + between_tries_us);
    if (fingers_.empty() && now_us_ - changed_us_ >= quiet_us && now_us_ >= next_save_us_) save();
}

void PaintScene::save() {
    if (is_saved_ || file_.empty()) return;
    try {
        save_painting(file_, painting_, surface_.T_g_c());
        is_saved_ = true;
        unsaved_.clear();
    } catch (const Error& error) {
        if (unsaved_ != error.what()) log_warning("the painting is not saved: {}", error.what());
        unsaved_ = error.what();
        next_save_us_ = now_us_ + between_tries_us;
    }
}

}  // namespace touchstone
