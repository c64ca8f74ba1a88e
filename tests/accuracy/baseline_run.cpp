#include "tests/accuracy/baseline_run.hpp"

#include <cmath>
#include <limits>
#include <map>

#include "platform/openni2_drivers/simulator/simulator_source.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using namespace baselines;

constexpr int background_frames = 100;
constexpr int farthest_px = 20;

using PixelLog = std::map<int, std::vector<PixelTouch>>;

TouchLog with_points(const PixelLog& pixels, const Background& background, const Intrinsics& k) {
    TouchLog log;
    for (const auto& [frame, touches] : pixels)
        for (const PixelTouch& touch : touches)
            log[frame].push_back({touch.id, surface_point_mm(background, k, touch.pixel_px)});
    return log;
}

/// Depth at a pixel or near it, mm; 0 = none.
double depth_near_mm(const Raster<float>& mean_mm, int u, int v) {
    double depth_mm = 0.0, nearest = std::numeric_limits<double>::infinity();
    for (int y = v - farthest_px; y <= v + farthest_px; ++y)
        for (int x = u - farthest_px; x <= u + farthest_px; ++x) {
            if (!mean_mm.has(x, y) || mean_mm.at(x, y) <= 0.0F) continue;
            const double distance_px = std::hypot(x - u, y - v);
            if (distance_px >= nearest) continue;
            nearest = distance_px;
            depth_mm = static_cast<double>(mean_mm.at(x, y));
        }
    return depth_mm;
}

}  // namespace

std::array<double, 3> surface_point_mm(const Background& background, const Intrinsics& k,
                                       const Eigen::Vector2d& pixel_px) {
    const double z_mm = depth_near_mm(background.mean_mm, static_cast<int>(std::lround(pixel_px.x())),
                                      static_cast<int>(std::lround(pixel_px.y())));
    return {z_mm * (pixel_px.x() - static_cast<double>(k.cx_px)) / static_cast<double>(k.fx_px),
            z_mm * (pixel_px.y() - static_cast<double>(k.cy_px)) / static_cast<double>(k.fy_px), z_mm};
}

BaselineRun run_baselines(const std::string& scene, std::vector<Method>& methods) {
    const TemporaryFolder folder;
    const std::string truth = (folder / "truth.json").string();
    const auto source = open_simulator(scene + "&truth=" + truth);
    const Intrinsics k = source->info().intrinsics;
    Readings surface;
    std::vector<PixelLog> logs(methods.size());
    SourceFrame frame;
    while (source->next(frame)) {
        DepthPicture picture(k.width_px, k.height_px);
        picture.values = frame.depth_mm;
        if (surface.frames() < background_frames) surface.add(picture);
        for (std::size_t i = 0; i < methods.size(); ++i)
            logs[i][frame.index] = methods[i].baseline->process(picture);
    }
    const Background background = surface.statistics();
    BaselineRun run{read_touch_truth(truth), {}};
    for (const PixelLog& log : logs) run.logs.push_back(with_points(log, background, k));
    return run;
}

}  // namespace touchstone
