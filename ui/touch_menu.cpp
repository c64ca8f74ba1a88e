#include "ui/touch_menu.hpp"

#include <algorithm>
#include <cctype>

namespace touchstone {

namespace {

constexpr std::uint64_t stays_open_us = 6'000'000;

std::string titled(std::string name) {
    if (!name.empty()) name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
    return name;
}

}  // namespace

TouchMenu::TouchMenu(std::vector<std::string> scenes) : scenes_(std::move(scenes)) {
    Button handle;
    handle.icon = Icon::menu;
    handle_.set({handle});
}

bool TouchMenu::on_touch(const TouchEvent& event) {
    if (handle_.is_touched() && handle_.on_touch(event)) return true;
    if (row_.is_touched() && row_.on_touch(event)) return true;
    const auto closing = std::find(closing_fingers_.begin(), closing_fingers_.end(), event.tip.id);
    if (event.phase != TouchPhase::down) {
        if (closing == closing_fingers_.end()) return false;
        if (event.phase == TouchPhase::up) closing_fingers_.erase(closing);
        return true;
    }
    touched_us_ = now_us_;
    if (!open_) return handle_.on_touch(event);
    if (row_.on_touch(event)) return true;
    open_ = false;
    closing_fingers_.push_back(event.tip.id);
    return true;
}

std::optional<std::string> TouchMenu::update(std::uint64_t now_us) {
    now_us_ = now_us;
    touched_us_ = std::min(touched_us_, now_us);
    if (!handle_.update(now_us).empty()) open_ = true;
    const std::vector<int> chosen = row_.update(now_us);
    if (open_ && !row_.is_touched() && now_us - touched_us_ > stays_open_us) open_ = false;
    if (chosen.empty()) return std::nullopt;
    open_ = false;
    return scenes_.at(static_cast<std::size_t>(chosen.back()));
}

void TouchMenu::close() {
    open_ = false;
    handle_.cancel();
    row_.cancel();
    closing_fingers_.clear();
}

void TouchMenu::draw(Canvas& canvas, const ViewMapping& view, const SurfaceGeometry& surface,
                     const std::string& shown_scene) {
    if (!open_) {
        handle_.lay_out(canvas, view, surface);
        handle_.draw(canvas, view);
        return;
    }
    std::vector<Button> buttons;
    for (std::size_t i = 0; i < scenes_.size(); ++i) {
        Button button;
        button.id = static_cast<int>(i);
        button.icon = scene_icon(scenes_[i]);
        button.label = titled(scenes_[i]);
        button.selected = scenes_[i] == shown_scene;
        buttons.push_back(std::move(button));
    }
    row_.set(std::move(buttons));
    row_.lay_out(canvas, view, surface);
    row_.draw(canvas, view);
}

Eigen::AlignedBox2f TouchMenu::place_px(const std::string& scene) const {
    const auto found = std::find(scenes_.begin(), scenes_.end(), scene);
    return row_.place_px(static_cast<int>(found - scenes_.begin()));
}

}  // namespace touchstone
