#pragma once

#include "tests/accuracy/baselines/background.hpp"

namespace touchstone::baselines {

/// How high a reading is over the background, as DIRECT sees it.
enum class Zone : std::uint8_t {
    unknown,  ///< no reading or no background
    edge,     ///< beside a step in depth: no blob passes it
    error,    ///< behind the background
    noise,
    low,
    mid,
    high,
};

struct ZoneConfig {
    float error_below_mm = -10.0F;
    float noise_below_sd = 0.7F;
    float low_below_mm = 12.0F;
    float mid_below_mm = 60.0F;
    float height_edge_mm = 50.0F;  ///< step in height that is an edge,
    int height_edge_px = 2;        ///< over so many pixels
    float depth_edge_mm = 100.0F;  ///< step in depth that is an edge,
    int depth_edge_px = 3;         ///< over so many pixels
};

struct Zones {
    Raster<Zone> zone;
    Raster<float> height_mm;  ///< over the background
};

Zones find_zones(const Background& background, const DepthPicture& picture, const ZoneConfig& config);

}  // namespace touchstone::baselines
