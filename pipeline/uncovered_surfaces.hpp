#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "pipeline/object_cutting.hpp"
#include "pipeline/objects_config.hpp"

namespace touchstone {

/// Finds surfaces that appeared behind the background and stand still: something of the scan was lifted away.
class UncoveredSurfaces {
  public:
    UncoveredSurfaces(const ObjectsConfig& config, const Intrinsics& intrinsics)
        : config_(config), intrinsics_(intrinsics) {}

    /// Whether update() is needed: much lies behind the background somewhere, or did so just before.
    bool wants(std::span<const std::uint8_t> rejection, const MapShape& shape);
    /// Those that have stood still long enough, free of everything that moves. Each is given once.
    std::vector<UncoveredSurface> update(const ObjectFrame& frame);
    /// Those that are waited for: not to be fused meanwhile.
    std::vector<UncoveredSurface> pending() const;
    void forget() { tracks_.clear(); }

  private:
    struct Track {
        UncoveredSurface surface;
        PixelRegion box;  ///< of what is inside
        int pixels = 0;
        int frames = 0;  ///< that it has stood still
        std::uint64_t first_us = 0;
        bool seen = false, given_up = false;
    };

    std::vector<Track> regions(const ObjectFrame& frame) const;
    Track make_region(std::span<const std::pair<int, int>> pixels, const ObjectFrame& frame) const;
    bool is_sized(const Track& region, const ObjectFrame& frame) const;
    void follow(Track& track, Track&& region, const ObjectFrame& frame) const;
    void average(Track& track, const ObjectFrame& frame) const;
    bool is_alone(const Track& track, const ObjectFrame& frame) const;
    void grow(UncoveredSurface& surface, const ObjectFrame& frame) const;

    ObjectsConfig config_;
    Intrinsics intrinsics_;
    std::vector<Track> tracks_;
    std::vector<int> seeds_;  ///< map index of a pixel in each tile with much behind the background
};

}  // namespace touchstone
