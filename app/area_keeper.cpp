#include "app/area_keeper.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <utility>

#include "app/area_scenes.hpp"
#include "app/areas_file.hpp"
#include "app/displays.hpp"
#include "pipeline/interactive_area.hpp"
#include "platform/system/error.hpp"
#include "platform/system/log.hpp"

namespace touchstone {

namespace {

constexpr float moved_m = 1e-3f, turned_rad = 1e-3f;  // less is no knock

bool is_elsewhere(const RigidTransform& before, const RigidTransform& after) {
    const RigidTransform T = before.inverse(Eigen::Isometry) * after;
    return T.translation().norm() > moved_m || Eigen::AngleAxisf(T.linear()).angle() > turned_rad;
}

/// Whether a place of the table, of a grid of some centimetres, is in it.
bool reaches_into(const NamedArea& area, const InteractiveArea& table) {
    constexpr int steps = 32;
    const PlaneFrame plane = plane_frame(table);
    for (int i = 0; i < steps * steps; ++i) {
        const Eigen::Vector2f uv =
            (Eigen::Vector2f(static_cast<float>(i % steps), static_cast<float>(i / steps)) +
             Eigen::Vector2f(0.5f, 0.5f)) /
            steps;
        if (is_inside(area.corners_mm, place_mm(plane, point_on(table, uv)))) return true;
    }
    return false;
}

}  // namespace

AreaKeeper::AreaKeeper(const RunOptions& options)
    : file_(options.config.areas_file),
      table_scene_(options.config.display.scene),
      is_kept_(!options.keeps_nothing),
      on_surface_(throws_on_table(options)) {
    if (!file_.empty()) load();
}

void AreaKeeper::load() {
    std::error_code none;
    if (!std::filesystem::exists(file_, none)) {
        log_info("no areas at {} yet: the whole table shows {}", file_, table_scene_);
        return;
    }
    try {
        std::vector<NamedArea> areas = load_areas_with_scenes(file_, table_scene_, on_surface_);
        log_info("{} areas from {}: {}", areas.size(), file_, told(areas, table_scene_));
        assignment_ = AreaAssignment(std::move(areas));
    } catch (const Error& error) {
        words_ = error.what();
        log_warning("{}; no area is used, the whole table shows {}", words_, table_scene_);
    }
}

void AreaKeeper::assign(const InteractionPipeline& pipeline, InteractionFrame& frame) {
    if (frame.state == InteractionState::scanning) T_g_c_.reset();
    const bool is_live = frame.state == InteractionState::live;
    if (!is_live) is_told_ = false;
    if (!pipeline.area()) return;
    if (is_live && !areas().empty()) follow_camera(*pipeline.area(), pipeline.background()->T_g_c());
    if (is_live && !std::exchange(is_told_, true)) tell_places(*pipeline.area());
    if (areas().empty()) return;
    assignment_.assign(*pipeline.area(), frame.touches, frame.hovers);
}

/// Where the white frame lies, in the numbers of the areas' file, and which areas do not reach into it.
void AreaKeeper::tell_places(const InteractiveArea& table) const {
    const PlaneFrame plane = plane_frame(table);
    std::string corners;
    for (const Eigen::Vector2f& uv : area_corners_uv) {
        const Eigen::Vector2f corner_mm = place_mm(plane, point_on(table, uv));
        corners +=
            fmt::format("{}[{:.0f}, {:.0f}]", corners.empty() ? "" : ", ", corner_mm.x(), corner_mm.y());
    }
    log_info("interactive area: {:.0f} x {:.0f} mm, corners_mm = [{}]", 1000.f * table.axis_u_c_m.norm(),
             1000.f * table.axis_v_c_m.norm(), corners);
    for (const NamedArea& area : areas())
        if (!reaches_into(area, table))
            log_warning("area {} lies outside the interactive area: no touch is promised there", area.name);
}

void AreaKeeper::follow_camera(const InteractiveArea& table, const RigidTransform& T_g_c) {
    if (!T_g_c_) T_g_c_ = T_g_c;
    if (!is_elsewhere(*T_g_c_, T_g_c)) return;
    const RigidTransform T_new_old = T_g_c.inverse(Eigen::Isometry) * *T_g_c_;
    const InteractiveArea before = transformed(T_new_old.inverse(Eigen::Isometry), table);
    assignment_ =
        AreaAssignment(moved(assignment_.areas(), plane_frame(before), T_new_old, plane_frame(table)));
    T_g_c_ = T_g_c;
    if (!can_change()) return;
    try {
        save_areas(file_, assignment_.areas());
    } catch (const Error& error) {
        log_warning("{}; after the next start the areas lie beside where they were", error.what());
    }
}

std::string AreaKeeper::free_name(const std::vector<NamedArea>& taken) const {
    for (int number = 1;; ++number) {
        std::string name = fmt::format("area-{}", number);
        if (std::ranges::find(taken, name, &NamedArea::name) == taken.end()) return name;
    }
}

/// Throws Error{configuration} where a draft is none.
std::vector<NamedArea> AreaKeeper::areas_of(std::span<const AreaDraft> drafts,
                                            const InteractiveArea& table) const {
    const PlaneFrame plane = plane_frame(table);
    std::vector<NamedArea> kept, all;
    for (const NamedArea& area : areas())
        if (std::ranges::find(drafts, area.name, &AreaDraft::name) != drafts.end()) kept.push_back(area);
    for (const AreaDraft& draft : drafts) {
        const auto known = std::ranges::find(kept, draft.name, &NamedArea::name);
        NamedArea& area = all.emplace_back(known != kept.end() ? *known : NamedArea{});
        area.scene = draft.scene;
        if (known != kept.end()) continue;
        kept.push_back(area);
        area.name = free_name(kept);
        kept.back().name = area.name;
        for (const Eigen::Vector2f& uv : draft.corners_uv)
            area.corners_mm.push_back(place_mm(plane, point_on(table, uv)));
        if (const std::string fault = fault_of(area.corners_mm); !fault.empty())
            throw Error(ExitStatus::configuration, fault);
    }
    check_scenes(all, table_scene_, on_surface_);
    return all;
}

bool AreaKeeper::change(std::span<const AreaDraft> drafts, const InteractiveArea& table) {
    words_.clear();
    if (!can_change()) return false;
    try {
        std::vector<NamedArea> changed = areas_of(drafts, table);
        save_areas(file_, changed);
        assignment_ = AreaAssignment(std::move(changed));
    } catch (const Error& error) {
        words_ = error.what();
        log_warning("the areas stay as they are: {}", words_);
        return false;
    }
    log_info("{} areas: {}", areas().size(), file_);
    return true;
}

std::vector<ShownArea> AreaKeeper::shown(const InteractionPipeline& pipeline,
                                         const Intrinsics& intrinsics) const {
    std::vector<ShownArea> shown;
    if (!pipeline.area()) return shown;
    const PlaneFrame plane = plane_frame(*pipeline.area());
    for (const NamedArea& named : areas()) {
        ShownArea& area = shown.emplace_back();
        area.name = named.name;
        area.scene = named.scene;
        area.triangles = triangles_of(named.corners_mm);
        area.area = bounding_area(plane, named.corners_mm);
        area.area_px = area_corners_px(area.area, intrinsics);
        for (const Eigen::Vector2f& corner : named.corners_mm) {
            area.corners_c_m.push_back(point_c_m(plane, corner));
            area.corners_px.push_back(project(intrinsics, area.corners_c_m.back()));
        }
    }
    return shown;
}

}  // namespace touchstone
