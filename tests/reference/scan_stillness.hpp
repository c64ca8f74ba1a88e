#pragma once

#include <algorithm>
#include <cmath>

#include "kernels/shared_types.h"

namespace touchstone::reference {

/// One pixel of a scan: what is taken to be the background, and what may replace it.
struct StillPixel {
    float mean_m = 0.0f, other_m = 0.0f;
    int frames = 0, other_frames = 0;
    bool moving = false, replaced = false;  ///< moving: in the last frame
};

/// One frame more; 0 is no reading.
inline void add_depth(StillPixel& pixel, float z_m, const SensorNoise& noise, float quantisation_per_m,
                      float sigmas, int least_frames) {
    pixel.moving = false;
    if (z_m <= 0.0f) return;
    const float sigma = noise.constant_m + noise.quadratic * (z_m - noise.offset_m) * (z_m - noise.offset_m);
    const float tolerance = sigmas * std::hypot(sigma, quantisation_per_m * z_m * z_m);
    if (pixel.frames == 0) {
        pixel.mean_m = z_m;
        pixel.frames = 1;
        return;
    }
    if (std::abs(z_m - pixel.mean_m) < tolerance) {
        pixel.frames = std::min(pixel.frames + 1, 250);
        pixel.mean_m += (z_m - pixel.mean_m) / static_cast<float>(pixel.frames);
        pixel.other_frames = 0;
        return;
    }
    if (pixel.other_frames > 0 && std::abs(z_m - pixel.other_m) < tolerance) {
        pixel.other_frames = std::min(pixel.other_frames + 1, 250);
        pixel.other_m += (z_m - pixel.other_m) / static_cast<float>(pixel.other_frames);
    } else {
        pixel.other_m = z_m;
        pixel.other_frames = 1;
    }
    const bool better = pixel.other_m > pixel.mean_m || pixel.frames < least_frames;
    if (pixel.other_frames >= least_frames && better && pixel.other_frames > 1) {
        pixel.mean_m = pixel.other_m;
        pixel.frames = pixel.other_frames;
        pixel.other_frames = 0;
        pixel.replaced = true;
        return;
    }
    pixel.moving = true;
}

}  // namespace touchstone::reference
