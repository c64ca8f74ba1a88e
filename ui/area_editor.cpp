#include "ui/area_editor.hpp"

#include <algorithm>

#include "pipeline/types.hpp"
#include "ui/hint_card.hpp"
#include "ui/scene_list.hpp"

namespace touchstone {

namespace {

using Eigen::Vector2f;

constexpr float closing_mm = 30.f;  // so near to the first corner a touch closes the area
constexpr float corner_disc_px = 8.f;

Button make_button(AreaButton what, Icon icon, std::string label) {
    Button button;
    button.id = static_cast<int>(what);
    button.icon = icon;
    button.label = std::move(label);
    return button;
}

Vector2f middle_px(const std::vector<Vector2f>& corners_px) {
    Vector2f sum(0.f, 0.f);
    for (const Vector2f& corner : corners_px) sum += corner;
    return sum / static_cast<float>(corners_px.size());
}

std::string scene_words(const std::string& scene) { return scene.empty() ? "the table's scene" : scene; }

}  // namespace

void AreaEditor::on_touch(const TouchEvent& event) {
    if (row_->on_touch(event)) return;
    const Corner place{event.tip.area_uv, event.tip.pixel_px, event.tip.area};
    if (event.phase == TouchPhase::down) {
        fingers_.insert_or_assign(event.tip.id, place);
        return;
    }
    const auto finger = fingers_.find(event.tip.id);
    if (finger == fingers_.end()) return;
    finger->second = place;
    if (event.phase != TouchPhase::up) return;
    fingers_.erase(finger);
    if (fingers_.empty() && !is_waiting_) take(place);  // of several, the last one points
}

void AreaEditor::take(const Corner& corner) {
    refusal_.clear();
    if (corners_.empty() && corner.area >= 0 && corner.area < std::ssize(areas_)) {
        const std::string& touched = areas_[static_cast<std::size_t>(corner.area)].name;
        chosen_ = chosen_ == touched ? std::string() : touched;
        return;
    }
    chosen_.clear();
    const bool closes = corners_.size() >= fewest_area_corners &&
                        (corner.pixel_px - corners_.front().pixel_px).norm() * mm_per_px_ < closing_mm;
    if (closes)
        finish();
    else if (corners_.size() < most_area_corners)
        corners_.push_back(corner);
}

bool AreaEditor::update(const TableFrame& frame, const OperatorView& view, OperatorWish& wish) {
    areas_ = frame.areas;
    const bool is_answered = is_waiting_ && view.area_lists == wish.area_lists;
    if (is_answered || view.areas != told_) refusal_ = told_ = view.areas;
    if (is_answered) is_waiting_ = false;
    if (chosen() == nullptr) chosen_.clear();
    bool stays = true;
    for (const int id : row_->update(frame.timestamp_us)) stays = press(static_cast<AreaButton>(id)) && stays;
    if (!changed_) return stays;
    wish.areas = *std::exchange(changed_, std::nullopt);
    ++wish.area_lists;
    is_waiting_ = true;
    return stays;
}

bool AreaEditor::press(AreaButton button) {
    switch (button) {
        case AreaButton::finish:
            finish();
            break;
        case AreaButton::undo:
            if (!corners_.empty()) corners_.pop_back();
            break;
        case AreaButton::scene:
            give_next_scene();
            break;
        case AreaButton::remove:
            remove();
            break;
        case AreaButton::other_edge:
            edge_ = edge_ == RowEdge::bottom ? RowEdge::top : RowEdge::bottom;
            row_ = std::make_unique<ButtonRow>(edge_);
            break;
        case AreaButton::done:
            return false;
    }
    return true;
}

std::vector<AreaDraft> AreaEditor::drafts() const {
    std::vector<AreaDraft> drafts;
    for (const ShownArea& area : areas_) drafts.push_back({area.name, area.scene});
    return drafts;
}

const ShownArea* AreaEditor::chosen() const {
    const auto found = std::ranges::find(areas_, chosen_, &ShownArea::name);
    return found == areas_.end() ? nullptr : &*found;
}

void AreaEditor::finish() {
    if (is_waiting_ || corners_.size() < fewest_area_corners) return;
    std::vector<AreaDraft> all = drafts();
    AreaDraft& made = all.emplace_back();
    for (const Corner& corner : corners_) made.corners_uv.push_back(corner.uv);
    corners_.clear();
    changed_ = std::move(all);
}

/// The table's own comes first again after the last. Those that cannot be beside the others' are passed over.
void AreaEditor::give_next_scene() {
    if (is_waiting_ || chosen() == nullptr) return;
    std::vector<AreaDraft> all = drafts();
    AreaDraft& draft = *std::ranges::find(all, chosen_, &AreaDraft::name);
    std::vector<std::string> choice{std::string()}, taken;
    choice.insert(choice.end(), scenes_.begin(), scenes_.end());
    for (const AreaDraft& other : all)
        if (&other != &draft) taken.push_back(other.scene);
    auto next = std::ranges::find(choice, draft.scene);
    std::rotate(choice.begin(), next == choice.end() ? next : next + 1, choice.end());
    next = std::ranges::find_if(choice, [&](const std::string& scene) {
        std::vector<std::string> together = taken;
        together.push_back(scene);
        return conflict_of(together).empty();
    });
    if (next == choice.end()) return;
    draft.scene = *next;
    changed_ = std::move(all);
}

void AreaEditor::remove() {
    if (is_waiting_) return;
    std::vector<AreaDraft> all = drafts();
    std::erase_if(all, [&](const AreaDraft& draft) { return draft.name == chosen_; });
    chosen_.clear();
    changed_ = std::move(all);
}

void AreaEditor::cancel() {
    row_->cancel();
    fingers_.clear();
}

std::vector<Button> AreaEditor::buttons() const {
    std::vector<Button> all;
    if (!corners_.empty()) {
        all.push_back(make_button(AreaButton::finish, Icon::finish, "Finish area"));
        all.back().enabled = corners_.size() >= fewest_area_corners;
        all.push_back(make_button(AreaButton::undo, Icon::undo, "Undo corner"));
    }
    if (const ShownArea* area = chosen()) {
        all.push_back(make_button(AreaButton::scene, scene_icon(area->scene), "Next scene"));
        all.push_back(make_button(AreaButton::remove, Icon::clear, "Remove area"));
        all.back().is_held = true;
    }
    all.push_back(make_button(AreaButton::other_edge, Icon::other_edge, "Other edge"));
    all.push_back(make_button(AreaButton::done, Icon::close, "Back"));
    all.back().gap_before = true;
    return all;
}

std::string AreaEditor::hint() const {
    if (!refusal_.empty()) return refusal_;
    if (const ShownArea* area = chosen()) return area->name + " shows " + scene_words(area->scene) + ".";
    if (corners_.empty())
        return "Touch the corners of a new area in order around it, or touch an area to change it.";
    if (corners_.size() < fewest_area_corners)
        return "Touch the next corner. It lies where the finger leaves.";
    return "Touch the next corner, or the first one again to finish.";
}

void AreaEditor::draw_areas(Canvas& canvas, const ViewMapping& view) const {
    for (const ShownArea& area : areas_) {
        const bool is_chosen = area.name == chosen_;
        const style::Color color = is_chosen ? style::accent : style::white;
        for (std::size_t i = 0; i < area.corners_px.size(); ++i)
            canvas.line(view.to_display(area.corners_px[i]),
                        view.to_display(area.corners_px[(i + 1) % area.corners_px.size()]),
                        (is_chosen ? 2.f : 1.f) * style::ring_px * canvas.scale(), color);
        const std::string words = area.name + "\n" + scene_words(area.scene);
        const Vector2f size = canvas.text_size_px(TextStyle::body, words);
        const Vector2f at = view.to_display(middle_px(area.corners_px)) - 0.5f * size;
        const Vector2f room = Vector2f::Constant(0.3f * style::margin_px * canvas.scale());
        canvas.box(at - room, at + size + room, style::corner_px * canvas.scale(), style::card);
        canvas.text(TextStyle::body, at, color, words);
    }
}

void AreaEditor::draw_new_one(Canvas& canvas, const ViewMapping& view) const {
    std::vector<Vector2f> places;
    for (const Corner& corner : corners_) places.push_back(view.to_display(corner.pixel_px));
    if (!fingers_.empty()) places.push_back(view.to_display(fingers_.begin()->second.pixel_px));
    for (std::size_t i = 0; i + 1 < places.size(); ++i)
        canvas.line(places[i], places[i + 1], style::ring_px * canvas.scale(), style::accent);
    for (const Vector2f& place : places) canvas.disc(place, corner_disc_px * canvas.scale(), style::accent);
    if (corners_.size() >= fewest_area_corners)
        canvas.ring(places.front(), 2.f * corner_disc_px * canvas.scale(), style::ring_px * canvas.scale(),
                    style::accent);
}

/// At the edge where the row is not.
void AreaEditor::draw_hint(Canvas& canvas, const ViewMapping& view) const {
    draw_hint_card(canvas, view, edge_ == RowEdge::bottom ? ViewEdge::top : ViewEdge::bottom,
                   refusal_.empty() ? style::text : style::warning, hint());
}

void AreaEditor::draw(Canvas& canvas, const ViewMapping& view, const SurfaceGeometry& surface) {
    mm_per_px_ = surface.mm_per_px(surface.room().box_px().center());
    row_->set(buttons());
    row_->lay_out(canvas, view, surface);
    draw_areas(canvas, view);
    draw_new_one(canvas, view);
    draw_hint(canvas, view);
    row_->draw(canvas, view);
}

}  // namespace touchstone
