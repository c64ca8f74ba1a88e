#pragma once

#include <cstdint>
#include <span>

#include "pipeline/maps.hpp"
#include "pipeline/pixel_region.hpp"
#include "platform/opencl/program.hpp"

namespace touchstone {

struct TouchMapConfig {
    SensorNoise noise{0.0012f, 0.0019f, 0.4f, 0.0001f};  ///< Kinect v1, Nguyen et al. 2012
    float finger_thickness_m = 0.018f;  ///< the camera sees the top of a finger that touches: a thick one
    float threshold_sigmas = 2.0f;      ///< of sigma_z: 95 % of the measurements of a touching finger
};

/// Listing 4 on the device. Both maps have the camera's MapShape.
struct TouchMap {
    TouchMap(const Device& device, const MapShape& map_shape)
        : shape(map_shape), height_m(device, map_pixels(map_shape)), touch(device, map_pixels(map_shape)) {}

    MapShape shape;
    /// Signed distance of the live point to the background, positive on the camera's side; UNKNOWN_HEIGHT_M
    /// where the live depth or the background around is missing. Only inside the boxes of the last update.
    Buffer<float> height_m;
    /// 255 where the foreground overlaps the background, else 0; the whole picture.
    Buffer<std::uint8_t> touch;
};

/// Listing 4: where foreground and background overlap, and how high the live points are.
class TouchMapping {
  public:
    TouchMapping(const Device& device, const TouchMapConfig& config, const Intrinsics& intrinsics);

    /// `live_m`: depth of what the camera sees now, `mask`: other than 0 on the foreground. Work is done only
    /// in the boxes, which lie in the picture.
    void update(const Buffer<float>& live_m, const Buffer<std::uint8_t>& mask,
                const SurfacePrediction& background, std::span<const PixelRegion> boxes, TouchMap& map);

  private:
    Intrinsics intrinsics_;
    MapShape shape_;
    TouchMapParams params_;
    Program program_;
    Kernel touch_map_;
};

}  // namespace touchstone
