#include "tests/accuracy/baselines/direct_zones.hpp"

#include <cmath>

namespace touchstone::baselines {
namespace {

constexpr float missing_below_mm = -10000.0F;

Zone zone_of(float mm, float sd_mm, const ZoneConfig& config) {
    if (mm < missing_below_mm) return Zone::unknown;
    if (mm < config.error_below_mm) return Zone::error;
    if (mm <= config.noise_below_sd * sd_mm) return Zone::noise;
    if (mm < config.low_below_mm) return Zone::low;
    return mm < config.mid_below_mm ? Zone::mid : Zone::high;
}

/// Whether a value changes by more than `step` to the right or down.
template <class Value, class Known>
bool has_step(const Raster<Value>& raster, int u, int v, int far_px, float step, Known known) {
    const float here = static_cast<float>(raster.at(u, v));
    const auto differs = [&](int x, int y) {
        if (!raster.has(x, y) || !known(raster.at(x, y))) return false;
        return std::abs(static_cast<float>(raster.at(x, y)) - here) > step;
    };
    return differs(u + far_px, v) || differs(u, v + far_px);
}

}  // namespace

Zones find_zones(const Background& background, const DepthPicture& picture, const ZoneConfig& config) {
    Zones zones{Raster<Zone>(picture.width_px, picture.height_px),
                Raster<float>(picture.width_px, picture.height_px)};
    for (std::size_t i = 0; i < picture.values.size(); ++i) {
        zones.height_mm.values[i] = height_mm(background, picture, i);
        zones.zone.values[i] = zone_of(zones.height_mm.values[i], background.sd_mm.values[i], config);
    }
    const auto is_height = [](float mm) { return mm >= missing_below_mm; };
    const auto is_reading = [](std::uint16_t mm) { return mm != 0; };
    for (int v = 0; v < picture.height_px; ++v)
        for (int u = 0; u < picture.width_px; ++u) {
            Zone& zone = zones.zone.at(u, v);
            if (zone == Zone::unknown) continue;
            if (has_step(zones.height_mm, u, v, config.height_edge_px, config.height_edge_mm, is_height) ||
                has_step(picture, u, v, config.depth_edge_px, config.depth_edge_mm, is_reading))
                zone = Zone::edge;
        }
    return zones;
}

}  // namespace touchstone::baselines
