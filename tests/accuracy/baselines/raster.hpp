#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace touchstone::baselines {

/// A picture, row-major, y down.
template <class Value>
struct Raster {
    Raster() = default;
    Raster(int wide_px, int high_px, Value value = {})
        : width_px(wide_px),
          height_px(high_px),
          values(static_cast<std::size_t>(wide_px) * static_cast<std::size_t>(high_px), value) {}

    int width_px = 0, height_px = 0;
    std::vector<Value> values;

    std::size_t index(int u, int v) const { return static_cast<std::size_t>(v * width_px + u); }
    int u_of(std::size_t i) const { return static_cast<int>(i) % width_px; }
    int v_of(std::size_t i) const { return static_cast<int>(i) / width_px; }
    bool has(int u, int v) const { return u >= 0 && v >= 0 && u < width_px && v < height_px; }
    Value& at(int u, int v) { return values[index(u, v)]; }
    const Value& at(int u, int v) const { return values[index(u, v)]; }
};

/// Millimetres, 0 = no reading.
using DepthPicture = Raster<std::uint16_t>;
/// 0 or 255.
using Mask = Raster<std::uint8_t>;
constexpr std::uint8_t set_value = 255;

/// Calls visit(i) for the pixels above, left, right and below that exist.
template <class Value, class Visit>
void for_each_neighbour(const Raster<Value>& raster, std::size_t i, Visit visit) {
    const int u = raster.u_of(i), v = raster.v_of(i);
    const auto wide = static_cast<std::size_t>(raster.width_px);
    if (v > 0) visit(i - wide);
    if (u > 0) visit(i - 1);
    if (u + 1 < raster.width_px) visit(i + 1);
    if (v + 1 < raster.height_px) visit(i + wide);
}

}  // namespace touchstone::baselines
