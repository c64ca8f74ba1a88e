#pragma once

#include "tests/accuracy/baselines/baseline.hpp"

namespace touchstone::baselines {

struct Block {
    int left_px, top_px, wide_px, high_px;
};

/// A level surface 1000 mm before the camera.
inline DepthPicture level_picture(int wide_px = 64, int high_px = 48) { return {wide_px, high_px, 1000}; }

template <class Value>
void fill(Raster<Value>& raster, const Block& block, Value value) {
    for (int v = block.top_px; v < block.top_px + block.high_px; ++v)
        for (int u = block.left_px; u < block.left_px + block.wide_px; ++u) raster.at(u, v) = value;
}

/// The level surface with a block so many millimetres over it.
inline DepthPicture with_block(DepthPicture picture, const Block& block, int height_mm) {
    fill(picture, block, static_cast<std::uint16_t>(1000 - height_mm));
    return picture;
}

/// Shows a baseline the empty surface for as long as every method needs.
inline void show_surface(Baseline& baseline, int frames = 101) {
    for (int i = 0; i < frames; ++i) baseline.process(level_picture());
}

}  // namespace touchstone::baselines
