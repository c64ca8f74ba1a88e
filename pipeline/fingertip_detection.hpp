#pragma once

#include <span>
#include <vector>

#include "pipeline/fingertip_measurement.hpp"
#include "pipeline/height_minima.hpp"
#include "pipeline/low_end.hpp"
#include "pipeline/pixel_region.hpp"
#include "pipeline/table_picture.hpp"

namespace touchstone {

struct FingertipDetectionConfig {
    HeightMinimaConfig minima;
    LowEndConfig low_end;
    FingertipMeasurementConfig measurement;
    float hand_area_m2 = 0.0015f;  ///< a finger belongs to something at least this large; a finger is 0.0010
    float same_tip_m = 0.010f;     ///< closer than this two tips are one
    float highest_m = 0.15f;       ///< of the pad; farther away a finger is of no interest
    float seed_reach_px = 6.0f;    ///< around a followed finger's place, where its low end is looked for
};

/// Ends of fingers inside the regions, found by their shape: low ends of the foreground that a finger
/// explains. `known` are the fingers followed so far, at their expected places.
std::vector<FingertipCandidate> detect_fingertips(const TablePicture& picture,
                                                  std::span<const PixelRegion> regions,
                                                  std::span<const KnownFinger> known,
                                                  const FingertipDetectionConfig& config);

}  // namespace touchstone
