#include "platform/openni2_drivers/simulator/mask_files.hpp"

#include <fmt/core.h>

#include "platform/image/png_file.hpp"

namespace touchstone::sim {

void write_masks(const std::filesystem::path& folder, const SourceFrame& frame, const Picture& picture,
                 const Intrinsics& intrinsics) {
    Image8 mask{intrinsics.width_px, intrinsics.height_px, 1, {}};
    mask.pixels.reserve(picture.part.size());
    for (const std::uint8_t part : picture.part) mask.pixels.push_back(part != 0 ? 255 : 0);
    write_png(folder / fmt::format("truth-{:06d}.mask.png", frame.index), mask);
    write_png(folder / fmt::format("frame-{:06d}.depth.png", frame.index),
              Image16{intrinsics.width_px, intrinsics.height_px, frame.depth_mm});
}

}  // namespace touchstone::sim
