#pragma once

#include <algorithm>

namespace touchstone {

/// A rectangle of pixels: x0 <= x < x1, y0 <= y < y1.
struct PixelRegion {
    int x0 = 0;
    int y0 = 0;
    int x1 = 0;
    int y1 = 0;

    int width_px() const { return x1 - x0; }
    int height_px() const { return y1 - y0; }
    bool empty() const { return x1 <= x0 || y1 <= y0; }
    bool contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
};

/// The box with a margin on each side, cut to the picture.
inline PixelRegion grown(const PixelRegion& box, int margin_px, int width_px, int height_px) {
    return {std::max(0, box.x0 - margin_px), std::max(0, box.y0 - margin_px),
            std::min(width_px, box.x1 + margin_px), std::min(height_px, box.y1 + margin_px)};
}

/// The region in whole blocks of block_px x block_px pixels, cut to the picture.
inline PixelRegion whole_blocks(const PixelRegion& region, int block_px, int width_px, int height_px) {
    const auto up = [&](int px) { return (px + block_px - 1) / block_px * block_px; };
    return {region.x0 / block_px * block_px, region.y0 / block_px * block_px,
            std::min(width_px, up(region.x1)), std::min(height_px, up(region.y1))};
}

inline bool overlap(const PixelRegion& a, const PixelRegion& b) {
    return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

inline PixelRegion hull(const PixelRegion& a, const PixelRegion& b) {
    return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

}  // namespace touchstone
