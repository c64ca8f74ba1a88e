#pragma once

#include "pipeline/particle_simulation.hpp"

namespace touchstone {

inline constexpr float particle_frame_s = 1.0f / 30.0f;
inline constexpr float particle_table_m = 0.1f;  ///< the surface is the plane z of that

/// A flat surface in a cube of 1.5 m, with free space above it.
TsdfVolume particle_table_volume(const Device& device);

/// A block three deep in the middle of the surface.
std::vector<Particle> particle_block(int count, float radius_m);

/// Two hands of 700 still spheres each, one layer, whose corners are at `at_m`.
std::vector<Particle> hands_at(const Eigen::Vector3f& one_m, const Eigen::Vector3f& other_m);

/// So many particles three deep on the surface, two hands of still spheres among them.
class ParticleBench {
  public:
    ParticleBench(const Device& device, int count);
    /// Waits for the device.
    void next_frame();

  private:
    const Device* device_;
    TsdfVolume volume_;
    ParticleSimulation simulation_;
};

}  // namespace touchstone
