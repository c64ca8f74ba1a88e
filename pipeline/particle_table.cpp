#include "pipeline/particle_table.hpp"

#include <algorithm>
#include <cmath>

#include "pipeline/map_shape.hpp"

namespace touchstone {

namespace {

constexpr float gravity = 9.81f;
constexpr float longest_frame_s = 0.1f;
constexpr int frames_per_forgetting = 15;

std::vector<std::uint16_t> nearest_real_mm(const ParticleTableFrame& frame, const Intrinsics& k) {
    const auto live_m = frame.live.depth_m.map_read();
    const auto model_m = frame.background.depth_m.map_read();
    const auto width = static_cast<std::size_t>(k.width_px);
    std::vector<std::uint16_t> depth_mm(frame.foreground.size());
    for (int y = 0; y < k.height_px; ++y) {
        const float* live = &live_m[map_index(frame.live.shape, 0, y)];
        const float* model = &model_m[map_index(frame.live.shape, 0, y)];
        const std::uint8_t* foreground = &frame.foreground[static_cast<std::size_t>(y) * width];
        std::uint16_t* row = &depth_mm[static_cast<std::size_t>(y) * width];
        for (std::size_t x = 0; x < width; ++x) {
            const float z_m = foreground[x] != 0 && live[x] > 0.0f ? live[x] : model[x];
            row[x] = static_cast<std::uint16_t>(1000.0f * z_m + 0.5f);
        }
    }
    return depth_mm;
}

}  // namespace

Eigen::Vector3f tilted_down(const InteractiveArea& area, const Eigen::Vector2f& tilt) {
    return (tilt.x() * area.axis_u_c_m.normalized() + tilt.y() * area.axis_v_c_m.normalized() -
            facing_normal(area))
        .normalized();
}

std::vector<Particle> foreground_spheres(const ParticleTableFrame& frame, const Intrinsics& intrinsics,
                                         int step_px, float radius_m) {
    const auto live_m = frame.live.depth_m.map_read();
    std::vector<Particle> spheres;
    for (int y = 0; y < intrinsics.height_px; y += step_px) {
        for (int x = 0; x < intrinsics.width_px; x += step_px) {
            const auto pixel = static_cast<std::size_t>(y * intrinsics.width_px + x);
            const float z_m = live_m[map_index(frame.live.shape, x, y)];
            if (frame.foreground[pixel] == 0 || z_m <= 0.0f) continue;
            const Eigen::Vector3f point_c_m = back_project(intrinsics, x, y, z_m);
            spheres.push_back({frame.T_g_c * (point_c_m + radius_m * point_c_m.normalized())});
        }
    }
    return spheres;
}

ParticleTable::ParticleTable(const Device& device, const ParticleTableConfig& config,
                             const Intrinsics& intrinsics)
    : config_(config), intrinsics_(intrinsics), simulation_(device, config.simulation) {}

ParticleView ParticleTable::advance(const ParticleTableFrame& frame) {
    const auto passed_us = static_cast<float>(frame.timestamp_us - std::min(last_us_, frame.timestamp_us));
    const float dt_s = last_us_ == 0 ? 0.0f : std::min(1e-6f * passed_us, longest_frame_s);
    last_us_ = frame.timestamp_us;
    take_touches(frame);
    pour(frame, dt_s);
    set_hands(frame);
    simulation_.set_gravity(gravity * (frame.T_g_c.linear() * tilted_down(frame.area, frame.tilt)));
    simulation_.advance(dt_s, &frame.surface);
    if (++frames_ % frames_per_forgetting == 0) forget_fallen(frame);
    return view(frame);
}

void ParticleTable::take_touches(const ParticleTableFrame& frame) {
    for (const TouchEvent& event : frame.touches) {
        if (event.phase == TouchPhase::up)
            fingers_.erase(event.tip.id);
        else
            fingers_.insert_or_assign(event.tip.id, event.tip);
    }
}

std::vector<Fingertip> ParticleTable::spouts(const ParticleTableFrame& frame) const {
    std::vector<Fingertip> spouts;
    for (const auto& [id, tip] : fingers_)
        if (frame.pouring == nullptr || std::ranges::find(*frame.pouring, id) != frame.pouring->end())
            spouts.push_back(tip);
    return spouts;
}

void ParticleTable::pour(const ParticleTableFrame& frame, float dt_s) {
    const std::vector<Fingertip> fingers = spouts(frame);
    if (static_cast<int>(fingers.size()) >= config_.clearing_fingers) return simulation_.clear();
    owed_ += config_.pour_per_s * dt_s;
    const int each = static_cast<int>(owed_);
    owed_ -= static_cast<float>(each);
    std::uniform_real_distribution<float> jitter(-0.5f, 0.5f);
    const Eigen::Vector3f up_c = facing_normal(frame.area);
    std::vector<Particle> poured;
    for (const Fingertip& tip : fingers) {
        const Eigen::Vector3f ahead_c = -(tip.axis_c - tip.axis_c.dot(up_c) * up_c).normalized();
        const Eigen::Vector3f spout_c_m = tip.surface_c_m + config_.pour_ahead_m * ahead_c +
                                          (config_.pour_height_m + config_.simulation.radius_m) * up_c;
        for (int i = 0; i < each; ++i) {
            const Eigen::Vector3f spread(jitter(random_), jitter(random_), jitter(random_));
            const Eigen::Vector3f place_c_m = spout_c_m + 2.0f * config_.simulation.radius_m * spread;
            const Eigen::Vector3f velocity_c = config_.pour_speed * (ahead_c + 0.5f * up_c + spread);
            poured.push_back({frame.T_g_c * place_c_m, frame.T_g_c.linear() * velocity_c});
        }
    }
    simulation_.add(poured);
}

void ParticleTable::set_hands(const ParticleTableFrame& frame) {
    std::vector<Fingertip> tips;
    for (const auto& [id, tip] : fingers_) tips.push_back(tip);
    for (const HoverEvent& hover : frame.hovers) tips.push_back(hover.tip);
    hands_.see(tips, frame.T_g_c, frame.timestamp_us);
    std::vector<Particle> spheres =
        foreground_spheres(frame, intrinsics_, config_.still_step_px, config_.simulation.still_radius_m);
    for (Particle& sphere : spheres) sphere.velocity = hands_.velocity_at(sphere.position_m);
    simulation_.set_still(spheres);
}

void ParticleTable::forget_fallen(const ParticleTableFrame& frame) {
    const Eigen::Vector3f up_g = frame.T_g_c.linear() * facing_normal(frame.area);
    const Eigen::Vector3f origin_g_m = frame.T_g_c * frame.area.origin_c_m;
    simulation_.remove_if([&](const Particle& particle) {
        return up_g.dot(particle.position_m - origin_g_m) < -config_.forget_below_m;
    });
}

ParticleView ParticleTable::view(const ParticleTableFrame& frame) const {
    ParticleView view{intrinsics_, config_.simulation.radius_m, {}, nearest_real_mm(frame, intrinsics_)};
    const RigidTransform T_c_g = frame.T_g_c.inverse();
    const Eigen::Vector3f up_c = facing_normal(frame.area);
    for (const Particle& particle : simulation_.particles()) {
        const Eigen::Vector3f centre_c_m = T_c_g * particle.position_m;
        const float height_m = up_c.dot(centre_c_m - frame.area.origin_c_m);
        const float shadow =
            std::clamp(1.0f - (height_m - view.radius_m) / config_.fade_height_m, 0.0f, 1.0f);
        view.spheres.push_back({centre_c_m, centre_c_m - height_m * up_c, shadow, particle.id});
    }
    std::ranges::sort(view.spheres, std::ranges::greater{},
                      [](const ParticleSphere& sphere) { return sphere.centre_c_m.z(); });
    return view;
}

}  // namespace touchstone
