#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "pipeline/particle_simulation.hpp"

namespace touchstone::reference {

/// Acceleration of a particle by a contact: `depth_m` along the unit vector `n` that points to it; `v` is its
/// velocity against the other's.
inline Eigen::Vector3f contact(const ParticleConfig& c, float depth_m, const Eigen::Vector3f& n,
                               const Eigen::Vector3f& v) {
    if (depth_m <= 0.0f) return Eigen::Vector3f::Zero();
    const float apart = v.dot(n);
    const float push = std::max(c.stiffness * depth_m - c.damping * apart, 0.0f);
    const Eigen::Vector3f slide = v - apart * n;
    const float drag = std::min(c.shear, c.friction * push / std::sqrt(slide.squaredNorm() + 1e-12f));
    return push * n - drag * slide;
}

inline Eigen::Vector3f by_sphere(const ParticleConfig& c, const Particle& self, const Particle& other,
                                 float reach_m) {
    const Eigen::Vector3f d = self.position_m - other.position_m;
    const float distance_m = d.norm();
    if (distance_m <= 0.0f) return Eigen::Vector3f::Zero();
    return contact(c, reach_m - distance_m, d / distance_m, self.velocity - other.velocity);
}

inline Eigen::Vector3f by_walls(const ParticleConfig& c, const Particle& p) {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (int axis = 0; axis < 3; ++axis) {
        const float low_m = c.radius_m - (p.position_m[axis] - c.low_m[axis]);
        const float high_m = c.radius_m - (c.high_m[axis] - p.position_m[axis]);
        if (low_m > 0.0f) sum[axis] += std::max(c.stiffness * low_m - c.damping * p.velocity[axis], 0.0f);
        if (high_m > 0.0f) sum[axis] -= std::max(c.stiffness * high_m + c.damping * p.velocity[axis], 0.0f);
    }
    return sum;
}

/// A sub-step of all particles, each with each.
inline std::vector<Particle> substep(const ParticleConfig& c, const std::vector<Particle>& particles,
                                     std::span<const Particle> still, const Eigen::Vector3f& gravity) {
    std::vector<Particle> next = particles;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        Eigen::Vector3f a = gravity + by_walls(c, particles[i]);
        for (std::size_t j = 0; j < particles.size(); ++j)
            if (i != j) a += by_sphere(c, particles[i], particles[j], 2.0f * c.radius_m);
        for (const Particle& other : still)
            a += by_sphere(c, particles[i], other, c.radius_m + c.still_radius_m);
        next[i].velocity += a * c.substep_s;
        const float speed = next[i].velocity.norm();
        if (speed > c.max_speed) next[i].velocity *= c.max_speed / speed;
        next[i].position_m += next[i].velocity * c.substep_s;
    }
    return next;
}

}  // namespace touchstone::reference
