#include "ui/scenes/photos.hpp"

#include "ui/sample_pictures.hpp"
#include "ui/table_frame.hpp"

namespace touchstone {

PhotosScene::PhotosScene(const SceneSetup& setup) : setup_(setup) {}

void PhotosScene::start(PixelSize view) {
    view_ = view;
    layer_.set_view(view);
    is_dirty_ = true;
}

void PhotosScene::show(const TableFrame& frame) {
    now_us_ = frame.timestamp_us;
    if (frame.state != "live") return;
    surface_ = SurfaceGeometry(frame, view_);
    table_.set_room(surface_.room(), mm_per_px());
    if (!is_open_) open();
}

/// Once the surface is known.
void PhotosScene::open() {
    is_open_ = true;
    GestureConfig config;
    config.mm_per_px = mm_per_px();
    gestures_.emplace(config, [this](const Eigen::Vector2f& place_px) { return table_.hit(place_px); });
    if (setup_.open_photos) stream_ = setup_.open_photos();
}

void PhotosScene::add(const Picture& picture, int of) {
    const int id =
        table_.add(static_cast<float>(picture.width_px) / static_cast<float>(picture.height_px), of);
    layer_.set_picture(id, picture);
}

/// One in a frame, so that the table never stands still.
void PhotosScene::take_next_picture() {
    if (shows_samples_ || !is_open_) return;
    if (stream_.next) {
        if (const std::optional<Picture> picture = stream_.next()) return add(*picture, stream_.count);
        stream_.next = nullptr;
    }
    if (!table_.cards().empty()) return;
    shows_samples_ = true;
    const std::vector<Picture> samples = sample_pictures();
    for (const Picture& picture : samples) add(picture, static_cast<int>(samples.size()));
}

void PhotosScene::on_touch(const TouchEvent& event) {
    if (!gestures_) return;
    gestures_->on_touch(event, now_us_);
    if (event.phase != TouchPhase::down) return;
    if (const auto id = table_.hit(event.tip.pixel_px)) table_.grasp(*id);
}

void PhotosScene::update(float dt_s) {
    take_next_picture();
    if (gestures_)
        for (const Gesture& gesture : gestures_->update(now_us_)) table_.on_gesture(gesture);
    is_dirty_ = table_.update(dt_s) || is_dirty_;
    if (!is_dirty_) return;
    layer_.draw(table_.cards(), mm_per_px());
    is_dirty_ = false;
}

void PhotosScene::draw(Canvas& canvas, const ViewMapping& view) {
    if (!shows_samples_) return;
    const std::string words =
        setup_.photo_folder.empty()
            ? "Your own pictures: name their folder in the configuration, [display] photos"
            : "Put your own pictures (PNG, JPEG) in " + setup_.photo_folder;
    const float s = canvas.scale();
    const Eigen::Vector2f room(14.f * s, 8.f * s);
    const Eigen::AlignedBox2f row = surface_.bottom_row(1.f);
    const float wrap_px = row.sizes().x() * view.display_px_per_px - 2.f * room.x();
    const Eigen::Vector2f size = canvas.text_size_px(TextStyle::caption, words, wrap_px);
    const Eigen::Vector2f foot = view.to_display({row.center().x(), row.max().y()});
    const Eigen::Vector2f at = foot - Eigen::Vector2f(0.5f * size.x(), size.y() + room.y());
    canvas.box(at - room, at + size + room, style::corner_px * s, style::card);
    canvas.text(TextStyle::caption, at, style::text, words, wrap_px);
}

}  // namespace touchstone
