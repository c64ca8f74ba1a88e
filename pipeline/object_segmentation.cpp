#include "pipeline/object_segmentation.hpp"

#include <filesystem>
#include <fmt/format.h>

#include "pipeline/mesh_file.hpp"
#include "pipeline/scan_file.hpp"
#include "pipeline/surface_mesh.hpp"
#include "platform/system/log.hpp"

namespace touchstone {

ObjectChanges ObjectSegmentation::update(const LiveMaps& live, const Foreground& foreground,
                                         std::span<const TouchEvent> touches, std::uint64_t timestamp_us,
                                         BackgroundModel& background) {
    ObjectChanges changes;
    const auto rejection = foreground.rejection.map_read();
    const bool uncovered = uncovered_.wants(rejection.values(), live.shape);
    if (!uncovered && foreground.components.empty() && still_.empty() && background.settled().empty())
        return changes;
    std::vector<Eigen::Vector2f> touches_px;
    for (const TouchEvent& touch : touches)
        if (touch.phase != TouchPhase::up) touches_px.push_back(touch.tip.pixel_px);
    const auto live_m = live.depth_m.map_read();
    const auto labels = foreground.labels.map_read();
    // A copy: what is found changes the prediction.
    const std::vector<float> predicted_m =
        uncovered ? background.prediction().depth_m.read() : std::vector<float>();
    const std::vector<std::uint8_t> settled =
        background.settled().empty() ? std::vector<std::uint8_t>() : background.settled().cover();
    const ObjectFrame frame{intrinsics_,     live.shape,         live_m.values(), predicted_m,
                            labels.values(), rejection.values(), settled,         foreground.components,
                            touches_px,      timestamp_us};
    changes.taken = background.drop_taken(frame);
    if (changes.taken > 0) log_info("{} taken away: the surface before it is back", changes.taken);
    const Found found = look(frame, uncovered && changes.taken == 0);
    for (const DepthPatch& patch : found.settled) background.settle(patch);
    changes.settled = static_cast<int>(found.settled.size());
    if (changes.settled > 0)
        log_info("{} put down: background from now on ({} such)", changes.settled,
                 background.settled().count());
    for (const UncoveredSurface& surface : found.lifted) {
        changes.lifted.push_back(background.cut_out(surface, frame));
        log_info("lifted out of the scan: {} bricks", changes.lifted.back().bricks.size());
        export_object(changes.lifted.back(), background.T_g_c());
    }
    const std::vector<UncoveredSurface> pending = uncovered_.pending();
    const bool waits = !pending.empty();
    if (waits || waited_ || changes.taken > 0 || changes.settled > 0) background.leave_out(pending);
    waited_ = waits;
    return changes;
}

ObjectSegmentation::Found ObjectSegmentation::look(const ObjectFrame& frame, bool uncovered) {
    Found found;
    found.settled = still_.update(frame);
    if (uncovered) found.lifted = uncovered_.update(frame);
    return found;
}

void ObjectSegmentation::forget() {
    still_.forget();
    uncovered_.forget();
    waited_ = false;
}

void ObjectSegmentation::export_object(const VolumeSnapshot& object, const RigidTransform& T_g_c) {
    if (config_.export_dir.empty()) return;
    const std::filesystem::path folder(config_.export_dir);
    std::filesystem::path file;
    do {
        file = folder / fmt::format("object-{:03}.ply", ++exported_);
    } while (std::filesystem::exists(file));
    try {
        std::filesystem::create_directories(folder);
        const SurfaceMesh mesh = extract_surface(object);
        write_mesh(file, mesh);
        save_scan(std::filesystem::path(file).replace_extension("scan"), {object, intrinsics_, T_g_c, {}});
        log_info("{}: {} triangles", file.string(), mesh.triangles.size());
    } catch (const std::exception& error) {
        log_warning("a lifted object is not written: {}", error.what());
    }
}

}  // namespace touchstone
