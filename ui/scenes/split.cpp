#include "ui/scenes/split.hpp"

#include <algorithm>
#include <utility>

#include "ui/style.hpp"

namespace touchstone {

namespace {

/// A finger as its area's scene knows it.
Fingertip within(Fingertip tip) {
    tip.area_uv = tip.named_uv;
    return tip;
}

/// Paintings of two areas are two files.
SceneSetup setup_of(SceneSetup setup, const std::string& area) {
    if (!setup.painting_file.empty()) setup.painting_file += area_painting_suffix + area;
    return setup;
}

}  // namespace

SplitScene::Part SplitScene::make_part(const ShownArea& area, const TableFrame& frame) const {
    Part part{area, make_scene(area.scene.empty() ? table_scene_ : area.scene, setup_of(setup_, area.name),
                               place_)};
    if (view_.width_px == 0) return part;
    part.scene->start(view_);
    TableFrame first = frame;
    first.rendered = nullptr;
    show_part(part, first, -1);
    return part;
}

void SplitScene::set_areas(const TableFrame& frame) {
    const bool are_the_same =
        std::ranges::equal(parts_, frame.areas, [](const Part& part, const ShownArea& area) {
            return part.area.name == area.name && part.area.scene == area.scene;
        });
    if (are_the_same) return;
    lift_all_fingers();
    if (const auto view = wish().view) versions_before_ = view->version + 1;
    std::vector<Part> before = std::exchange(parts_, {});
    for (const ShownArea& area : frame.areas) {
        const auto known = std::ranges::find_if(before, [&](const Part& part) {
            return part.scene && part.area.name == area.name && part.area.scene == area.scene;
        });
        if (known == before.end())
            parts_.push_back(make_part(area, frame));
        else
            parts_.push_back({area, std::move(known->scene)});
    }
}

void SplitScene::start(PixelSize view) {
    view_ = view;
    for (Part& part : parts_) part.scene->start(view);
}

void SplitScene::show_part(Part& part, const TableFrame& frame, int index) const {
    TableFrame own = frame;
    own.has_area = own.is_part = true;
    own.area = part.area.area;
    own.area_px = part.area.area_px;
    own.areas.clear();
    const auto is_foreign = [&](const auto& event) { return event.tip.area != index; };
    std::erase_if(own.touches, is_foreign);
    std::erase_if(own.hovers, is_foreign);
    const bool is_old = own.rendered && own.rendered->version < versions_before_;
    if (!part.scene->wish().view || is_old) own.rendered = nullptr;
    part.scene->show(own);
}

void SplitScene::show(const TableFrame& frame) {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        if (i < frame.areas.size()) parts_[i].area = frame.areas[i];
        show_part(parts_[i], frame, static_cast<int>(i));
    }
}

SplitScene::Part* SplitScene::part_of(const Fingertip& tip) {
    const bool known = tip.area >= 0 && tip.area < std::ssize(parts_);
    return known ? &parts_[static_cast<std::size_t>(tip.area)] : nullptr;
}

void SplitScene::on_touch(const TouchEvent& event) {
    Part* part = part_of(event.tip);
    if (part == nullptr) return;
    if (event.phase == TouchPhase::down)
        touching_.insert_or_assign(event.tip.id, event.tip);
    else if (!touching_.contains(event.tip.id))
        return;
    if (event.phase == TouchPhase::up) touching_.erase(event.tip.id);
    part->scene->on_touch({within(event.tip), event.phase});
}

/// Those that stay down are nobody's afterwards.
void SplitScene::lift_all_fingers() {
    for (const auto& [id, tip] : std::exchange(touching_, {}))
        if (Part* part = part_of(tip)) part->scene->on_touch({within(tip), TouchPhase::up});
}

void SplitScene::on_hovers(std::span<const HoverEvent> hovers) {
    std::vector<HoverEvent> own;
    for (Part& part : parts_) {
        own.clear();
        for (const HoverEvent& hover : hovers)
            if (part_of(hover.tip) == &part) own.push_back({within(hover.tip)});
        part.scene->on_hovers(own);
    }
}

void SplitScene::update(float dt_s) {
    std::vector<AreaLayer> surfaces, overlays;
    for (Part& part : parts_) {
        part.scene->update(dt_s);
        surfaces.push_back({&part.area, part.scene->surface_layer()});
        overlays.push_back({&part.area, part.scene->overlay_layer()});
    }
    surface_layer_ = surface_.compose(view_, surfaces);
    overlay_layer_ = overlay_.compose(view_, overlays);
}

SceneWish SplitScene::wish() const {
    SceneWish all;
    for (const Part& part : parts_) {
        SceneWish wish = part.scene->wish();
        if (wish.view) all.view = std::move(wish.view);
        if (!wish.particles) continue;
        wish.view = std::move(all.view);
        all = std::move(wish);
    }
    if (all.view) all.view->version += versions_before_;
    return all;
}

std::string_view SplitScene::unsaved() const {
    for (const Part& part : parts_)
        if (!part.scene->unsaved().empty()) return part.scene->unsaved();
    return {};
}

void SplitScene::draw(Canvas& canvas, const ViewMapping& view) {
    for (const Part& part : parts_) part.scene->draw(canvas, view);
}

}  // namespace touchstone
