#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "pipeline/maps.hpp"
#include "pipeline/types.hpp"
#include "platform/opencl/program.hpp"

namespace touchstone {

struct RenderingConfig {
    /// Or "normals": as colours; or "camera": its own colour picture, where it has one.
    std::string view = "shaded";
    ShadingParams shading{
        .background = {0.62f, 0.66f, 0.72f, 0.16f},
        .foreground = {0.93f, 0.62f, 0.42f, 0.10f},
        .unknown = {0.055f, 0.063f, 0.078f, 0.0f},
        .light_c = {0.45f, 0.60f, 0.66f, 0.0f},
    };
};

/// The camera's own picture is wanted.
inline bool shows_camera(const RenderingConfig& config) { return config.view == "camera"; }

/// A surface of the foreground from the camera: the live one, or the raycast of its volumes.
struct ForegroundLayer {
    const Buffer<float>& normals_c;    ///< a pixel without normal is taken to face the camera
    const Buffer<std::uint8_t>& mask;  ///< not 0 where it is in front of the background
};

/// The camera's own picture (Fig 6 B): `rgb` of 3 bytes a pixel, alpha 0 where `foreground` is not 0; both
/// row-major, no padding, of the same size.
ShadedView camera_view(std::span<const std::uint8_t> rgb, std::span<const std::uint8_t> foreground,
                       const Intrinsics& intrinsics);

/// A map of pixels, red in the lowest byte, as a picture without padding. Waits for the device.
ShadedView read_view(const Buffer<std::uint32_t>& rgba, const MapShape& shape);

/// Fig 12c, Fig 14f, Fig 15: the camera's view, background and foreground shaded apart, or the normals of
/// both.
class Rendering {
  public:
    /// Throws Error{configuration} for a view that there is not.
    Rendering(const Device& device, const RenderingConfig& config, const Intrinsics& intrinsics);

    ShadedView render(const SurfacePrediction& background, const ForegroundLayer& foreground);

  private:
    RenderingConfig config_;
    Intrinsics intrinsics_;
    MapShape shape_;
    Program program_;
    Kernel show_;
    Buffer<std::uint32_t> rgba_;
};

}  // namespace touchstone
