#pragma once

#include <map>
#include <random>
#include <span>

#include "pipeline/hand_motion.hpp"
#include "pipeline/maps.hpp"
#include "pipeline/particle_simulation.hpp"
#include "pipeline/particle_view.hpp"
#include "pipeline/touch_event.hpp"
#include "pipeline/types.hpp"

namespace touchstone {

struct ParticleTableConfig {
    ParticleConfig simulation;
    float pour_per_s = 120.0f;     ///< from each finger in contact
    float pour_ahead_m = 0.022f;   ///< of the fingertip, away from the hand
    float pour_height_m = 0.015f;  ///< above the surface
    float pour_speed = 0.25f;      ///< m/s, away from the hand
    int still_step_px = 4;         ///< one pixel of the foreground in so many, each way, stands for it
    float forget_below_m = 0.20f;  ///< what has fallen so far below the surface's plane is gone
    int clearing_fingers = 4;      ///< in contact at once: all is cleared
    float fade_height_m = 0.12f;   ///< from which on a particle has no shadow
};

/// What a frame gives to the particles; all of one camera frame.
struct ParticleTableFrame {
    const LiveMaps& live;
    const SurfacePrediction& background;
    std::span<const std::uint8_t> foreground;  ///< not 0 where it is, row-major, no padding
    const TsdfVolume& surface;
    RigidTransform T_g_c = RigidTransform::Identity();
    InteractiveArea area;
    std::span<const TouchEvent> touches;
    std::uint64_t timestamp_us = 0;
    std::span<const HoverEvent> hovers = {};
    Eigen::Vector2f tilt{0.0f, 0.0f};           ///< as in SceneWish
    const std::vector<int>* pouring = nullptr;  ///< the fingers that do; null: all in contact
};

/// Fig 9 and 13 on a table: particles are poured from fingertips, lie on the surface, and are pushed, scooped
/// and held by whatever is in front of it. Gravity is along the plumb line of
/// the surface's plane, unless that is tilted.
class ParticleTable {
  public:
    ParticleTable(const Device& device, const ParticleTableConfig& config, const Intrinsics& intrinsics);

    /// Moves time on to the frame's.
    ParticleView advance(const ParticleTableFrame& frame);
    /// What they lay on is gone: it is scanned anew.
    void clear() { simulation_.clear(); }
    /// Nobody can touch: those that poured do not any more.
    void lift_fingers() {
        fingers_.clear();
        hands_.forget();
    }
    int count() const { return simulation_.count(); }

  private:
    void take_touches(const ParticleTableFrame& frame);
    std::vector<Fingertip> spouts(const ParticleTableFrame& frame) const;
    void pour(const ParticleTableFrame& frame, float dt_s);
    void set_hands(const ParticleTableFrame& frame);
    void forget_fallen(const ParticleTableFrame& frame);
    ParticleView view(const ParticleTableFrame& frame) const;

    ParticleTableConfig config_;
    Intrinsics intrinsics_;
    ParticleSimulation simulation_;
    std::map<int, Fingertip> fingers_;  // in contact
    HandMotion hands_;
    std::mt19937 random_{1};
    std::uint64_t last_us_ = 0;
    float owed_ = 0.0f;  // particles of each finger, below one
    int frames_ = 0;
};

/// Gravity over a tilted table, camera frame, length 1: to the surface, and by `tilt` along the area's u and
/// v.
Eigen::Vector3f tilted_down(const InteractiveArea& area, const Eigen::Vector2f& tilt);

/// The spheres that stand for the foreground: behind its surface, one for each step_px pixels each way.
/// Global frame, at rest.
std::vector<Particle> foreground_spheres(const ParticleTableFrame& frame, const Intrinsics& intrinsics,
                                         int step_px, float radius_m);

}  // namespace touchstone
