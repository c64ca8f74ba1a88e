#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "pipeline/types.hpp"

namespace touchstone {

/// A particle as the camera sees it.
struct ParticleSphere {
    Eigen::Vector3f centre_c_m{0.0f, 0.0f, 0.0f};
    Eigen::Vector3f shadow_c_m{0.0f, 0.0f, 0.0f};  ///< the foot of its plumb line on the surface's plane
    float shadow = 0.0f;                           ///< 0 none, 1 full
    int id = 0;
};

/// What the particles scene draws: spheres, and what of the real scene is in front of them.
struct ParticleView {
    Intrinsics intrinsics{};
    float radius_m = 0.0f;
    std::vector<ParticleSphere> spheres;  ///< the farthest first
    std::vector<std::uint16_t>
        depth_mm;  ///< nearest real surface per pixel, row-major, 0 unknown; empty: all unknown
};

}  // namespace touchstone
