#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "pipeline/touch_event.hpp"
#include "pipeline/types.hpp"

namespace touchstone {

struct HandMotionConfig {
    std::uint64_t span_us = 100'000;  ///< over which a speed is taken: three frames at 30 Hz
    float least_speed = 0.06f;        ///< m/s; what a resting finger's jitter feigns (2 mm) is less
    float most_speed = 1.0f;          ///< m/s
    float reach_m = 0.20f;            ///< of a fingertip: the rest of its hand
};

/// How fast hands move, by their fingertips. Global frame.
class HandMotion {
  public:
    explicit HandMotion(const HandMotionConfig& config = {}) : config_(config) {}

    /// All fingertips of a frame, in contact or hovering. Those that are not given any more are forgotten.
    void see(std::span<const Fingertip> tips, const RigidTransform& T_g_c, std::uint64_t timestamp_us);
    void forget() { hands_.clear(); }
    /// m/s, of the fingertip nearest to a place; nothing beyond its reach, or where it rests.
    Eigen::Vector3f velocity_at(const Eigen::Vector3f& place_g_m) const;

  private:
    struct Sample {
        Eigen::Vector3f place_g_m;
        std::uint64_t timestamp_us;
    };
    struct Hand {
        std::vector<Sample> samples;
        Eigen::Vector3f velocity{0.0f, 0.0f, 0.0f};
        std::uint64_t seen_us = 0;
    };

    HandMotionConfig config_;
    std::map<int, Hand> hands_;  // by the finger's id
};

}  // namespace touchstone
