#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "ui/gestures.hpp"

namespace touchstone {

/// What GestureRecognizer knows of a finger, from its down until it has been up for longer than a drop-out.
/// Places are pixels of the depth picture.
struct GestureFinger {
    struct Sample {
        Eigen::Vector2f place_px;
        std::uint64_t timestamp_us;
    };

    int id;
    std::uint64_t down_us;
    Eigen::Vector2f place_px;
    Eigen::Vector2f told_px = place_px;  ///< where it is by the gestures told so far
    /// The middle of its places of the first `velocity_us`: a single one is off by the jitter.
    Eigen::Vector2f rest_px = place_px;
    int rest_places = 1;
    int frames_outside = 0;  ///< of the tap radius about rest_px, in a row
    bool has_left = false;   ///< the tap radius
    bool held = false;       ///< a hold has been told
    bool hidden = false;     ///< in contact and not seen
    std::optional<std::uint64_t> lifted_us = std::nullopt;
    std::vector<Sample> samples = {{place_px, down_us}};  ///< of the last `velocity_us`
    Eigen::Vector2f lift_velocity_px_s{0.f, 0.f};

    bool in_sight() const { return !hidden && !lifted_us; }
    void move(const Eigen::Vector2f& to_px, std::uint64_t now_us, const GestureConfig& config);
    void lift(std::uint64_t now_us, const GestureConfig& config);
    /// From the line between where it was last and where it would be had it kept its speed.
    float distance_to_way_px(const Eigen::Vector2f& point_px, std::uint64_t now_us) const;
};

}  // namespace touchstone
