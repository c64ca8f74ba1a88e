#pragma once

#include <cstdint>

#include "pipeline/maps.hpp"
#include "pipeline/types.hpp"
#include "platform/opencl/program.hpp"

namespace touchstone {

struct RenderingConfig {
    ShadingParams shading{
        .background = {0.62f, 0.66f, 0.72f, 0.16f},
        .foreground = {0.93f, 0.62f, 0.42f, 0.10f},
        .unknown = {0.055f, 0.063f, 0.078f, 0.0f},
        .light_c = {0.45f, 0.60f, 0.66f, 0.0f},
    };
};

/// Fig 12c, Fig 14f: the camera's view, background and foreground shaded apart.
class Rendering {
  public:
    Rendering(const Device& device, const RenderingConfig& config, const Intrinsics& intrinsics);

    /// `foreground`: not 0 where the pixel moves.
    ShadedView render(const SurfacePrediction& background, const LiveMaps& live,
                      const Buffer<std::uint8_t>& foreground);

  private:
    RenderingConfig config_;
    Intrinsics intrinsics_;
    MapShape shape_;
    Program program_;
    Kernel shade_view_;
    Buffer<std::uint32_t> rgba_;
};

}  // namespace touchstone
