#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/depth_patch.hpp"
#include "pipeline/objects_config.hpp"

namespace touchstone {

/// Follows the components of the foreground and finds those that were put down: alone in the picture, still,
/// no part of a hand.
class StillComponents {
  public:
    StillComponents(const ObjectsConfig& config, const Intrinsics& intrinsics)
        : config_(config), intrinsics_(intrinsics) {}

    /// What has been still for settle_s, with the mean of its depth over that time. Each is given once.
    std::vector<DepthPatch> update(const ObjectFrame& frame);
    /// The camera is elsewhere.
    void forget() { tracks_.clear(); }
    bool empty() const { return tracks_.empty(); }

  private:
    struct Track {
        DepthPatch mean;  ///< samples stop at 255
        int frames = 0;
        std::uint64_t since_us = 0, seen_us = 0;
        bool seen = false;  ///< in this frame
    };

    bool may_settle(const ForegroundComponent& component, const ObjectFrame& frame) const;
    Track start(const ForegroundComponent& component, const ObjectFrame& frame) const;
    Track* find(const PixelRegion& box);
    bool add(Track& track, const ForegroundComponent& component, const ObjectFrame& frame) const;
    bool has_settled(const Track& track, const ObjectFrame& frame, const std::vector<bool>& moves) const;

    ObjectsConfig config_;
    Intrinsics intrinsics_;
    std::vector<Track> tracks_;
};

}  // namespace touchstone
