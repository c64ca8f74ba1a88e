#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/radix_sort.hpp"
#include "pipeline/tsdf_volume.hpp"

namespace touchstone {

/// Over the mass of a particle where a force is meant.
struct ParticleConfig {
    int capacity = 4096;            ///< more push out the oldest
    float radius_m = 0.005f;        ///< of each
    float still_radius_m = 0.006f;  ///< of those that stand for hands
    /// In a dense heap eight times the stiffness and damping of one contact can act on a particle:
    /// 16 damping dt + 8 stiffness dt^2 below 4 is stable, here 3.4.
    float stiffness = 10000.0f;       ///< 1/s^2: a particle at rest sinks g / stiffness = 1 mm in
    float damping = 30.0f;            ///< 1/s, along the contact
    float shear = 30.0f;              ///< 1/s, across it, between spheres ...
    float friction = 0.5f;            ///< ... at most so much of the push, which the surface holds altogether
    float max_speed = 1.2f;           ///< m/s: a radius in a sub-step, so that nothing is passed unseen
    float substep_s = 1.0f / 240.0f;  ///< time always goes on by this
    int most_substeps = 16;           ///< at once; time that is left over is lost, not made up for
    Eigen::Vector3f low_m{-10.0f, -10.0f, -10.0f}, high_m{10.0f, 10.0f, 10.0f};  ///< walls of a closed box
};

struct Particle {
    Eigen::Vector3f position_m{0.0f, 0.0f, 0.0f};  ///< of its middle, global frame
    Eigen::Vector3f velocity{0.0f, 0.0f, 0.0f};    ///< m/s
    int id = 0;                                    ///< counts up; given by the simulation
};

/// Fig 7, 9 and 13 after Harada (GPU Gems 3) and Green: spheres that collide by discrete elements (spring,
/// dashpot, friction) in a uniform grid that is sorted in every sub-step, with the surface of a volume and
/// with still spheres of the foreground.
class ParticleSimulation {
  public:
    ParticleSimulation(const Device& device, const ParticleConfig& config);

    /// Ids of those that are given do not matter.
    void add(std::span<const Particle> particles);
    void remove_if(const std::function<bool(const Particle&)>& goes);
    void clear();
    void set_gravity(const Eigen::Vector3f& gravity) { gravity_ = gravity; }
    /// Spheres in the way, at these places with these velocities, until they are set anew. Ids do not matter.
    void set_still(std::span<const Particle> still);
    /// Moves time on by whole sub-steps; what is left is kept for the next call. `surface` may be null.
    void advance(float dt_s, const TsdfVolume* surface);

    int count() const { return count_; }
    /// In the order of their ids. Waits for the device.
    std::vector<Particle> particles() const;

  private:
    /// What is sorted by cell: states in planes, ids beside them.
    struct Set {
        /// `reach_m`: no contact is further than this.
        Set(const Device& device, std::size_t capacity, float reach_m);
        void write(std::span<const Particle> particles);

        float cell_m;
        std::size_t plane;
        Buffer<float> state, sorted;
        Buffer<int> ids, sorted_ids, keys, places, starts;
        RadixSort sort;
    };

    void order(Set& set, int count);
    void substep(const TsdfVolume* surface);
    ParticleParams params(const TsdfVolume* surface) const;

    const Device* device_;
    ParticleConfig config_;
    Program program_;
    Kernel find_cells_, order_by_cell_, collide_, move_;
    Set moving_;
    std::optional<Set> still_;
    Buffer<float> acceleration_;
    Buffer<int> no_volume_;
    Eigen::AlignedBox3f still_bounds_;  // empty: none is in it
    Eigen::Vector3f gravity_{0.0f, 0.0f, 0.0f};
    int count_ = 0, next_id_ = 0;
    float time_left_s_ = 0.0f;
};

}  // namespace touchstone
