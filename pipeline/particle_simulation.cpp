#include "pipeline/particle_simulation.hpp"

#include <algorithm>
#include <cmath>

#include "pipeline/kernel_program.hpp"
#include "pipeline/map_shape.hpp"

namespace touchstone {

namespace {

constexpr std::size_t lanes = 8;
constexpr std::size_t planes = 6;
constexpr std::size_t group = 64;

LaunchSize eight_each(int count) {
    return {{round_up(ceil_div(static_cast<std::size_t>(count), lanes), lanes), 1, 1}, {lanes, 1, 1}};
}

LaunchSize one_each(int count) {
    return {{round_up(static_cast<std::size_t>(count), group), 1, 1}, {group, 1, 1}};
}

Float4 to_float4(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z(), 0.0f}; }

}  // namespace

/// A work-group beyond the capacity, and what a load of eight reads behind it.
ParticleSimulation::Set::Set(const Device& device, std::size_t capacity, float reach_m)
    : cell_m(reach_m),
      plane(round_up(capacity, group) + lanes),
      state(device, planes * plane + lanes),
      sorted(device, planes * plane + lanes),
      ids(device, plane),
      sorted_ids(device, plane),
      keys(device, plane),
      places(device, plane),
      starts(device, PARTICLE_CELLS + 1),
      sort(device, plane) {
    state.fill(0.0f);
    sorted.fill(0.0f);
    starts.fill(0);
}

void ParticleSimulation::Set::write(std::span<const Particle> particles) {
    const auto values = state.map_update();
    const auto id_values = ids.map_update();
    for (std::size_t i = 0; i < particles.size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto at = static_cast<Eigen::Index>(axis);
            values[axis * plane + i] = particles[i].position_m[at];
            values[(3 + axis) * plane + i] = particles[i].velocity[at];
        }
        id_values[i] = particles[i].id;
    }
}

ParticleSimulation::ParticleSimulation(const Device& device, const ParticleConfig& config)
    : device_(&device),
      config_(config),
      program_(load_kernel_program(device, "particles.cl")),
      find_cells_(program_.kernel("find_cells")),
      order_by_cell_(program_.kernel("order_by_cell")),
      collide_(program_.kernel("collide")),
      move_(program_.kernel("move")),
      moving_(device, static_cast<std::size_t>(config.capacity), 2.0f * config.radius_m),
      acceleration_(device, 3 * moving_.plane + lanes),
      no_volume_(device, 1) {
    acceleration_.fill(0.0f);
    set_still({});
}

void ParticleSimulation::add(std::span<const Particle> particles) {
    if (particles.empty()) return;
    std::vector<Particle> all = this->particles();
    for (const Particle& particle : particles) {
        all.push_back(particle);
        all.back().id = next_id_++;
    }
    const auto capacity = static_cast<std::size_t>(config_.capacity);
    const std::size_t too_many = all.size() > capacity ? all.size() - capacity : 0;
    const auto kept = std::span(all).subspan(too_many);
    moving_.write(kept);
    count_ = static_cast<int>(kept.size());
}

void ParticleSimulation::remove_if(const std::function<bool(const Particle&)>& goes) {
    std::vector<Particle> all = particles();
    if (std::erase_if(all, goes) == 0) return;
    moving_.write(all);
    count_ = static_cast<int>(all.size());
}

void ParticleSimulation::clear() {
    count_ = 0;
    time_left_s_ = 0.0f;
}

void ParticleSimulation::set_still(std::span<const Particle> still) {
    if (!still_ || still_->plane < still.size() + lanes)
        still_.emplace(*device_, 2 * still.size() + group, config_.radius_m + config_.still_radius_m);
    still_->write(still);
    still_bounds_.setEmpty();
    for (const Particle& each : still) still_bounds_.extend(each.position_m);
    if (!still.empty()) order(*still_, static_cast<int>(still.size()));
}

void ParticleSimulation::order(Set& set, int count) {
    const auto plane = static_cast<int>(set.plane);
    find_cells_.launch(eight_each(count), set.state, set.keys, set.places, plane, set.cell_m);
    set.sort.sort(set.keys, set.places, count);
    order_by_cell_.launch(one_each(count), set.state, set.ids, set.keys, set.places, set.sorted,
                          set.sorted_ids, set.starts, plane, count);
    std::swap(set.state, set.sorted);
    std::swap(set.ids, set.sorted_ids);
}

ParticleParams ParticleSimulation::params(const TsdfVolume* surface) const {
    ParticleParams params{};
    params.gravity = to_float4(gravity_);
    params.low_m = to_float4(config_.low_m);
    params.high_m = to_float4(config_.high_m);
    params.still_low_m = to_float4(still_bounds_.min());
    params.still_high_m = to_float4(still_bounds_.max());
    params.radius_m = config_.radius_m;
    params.still_radius_m = config_.still_radius_m;
    params.stiffness = config_.stiffness;
    params.damping = config_.damping;
    params.shear = config_.shear;
    params.friction = config_.friction;
    params.dt_s = config_.substep_s;
    params.max_speed = config_.max_speed;
    params.cell_m = moving_.cell_m;
    params.still_cell_m = still_->cell_m;
    params.count = count_;
    params.plane = static_cast<int>(moving_.plane);
    params.still_plane = static_cast<int>(still_->plane);
    params.has_surface = surface != nullptr ? 1 : 0;
    return params;
}

void ParticleSimulation::substep(const TsdfVolume* surface) {
    order(moving_, count_);
    const ParticleParams all = params(surface);
    collide_.launch(one_each(count_), moving_.state, moving_.starts, still_->state, still_->starts,
                    acceleration_, all);
    move_.launch(eight_each(count_), moving_.state, acceleration_,
                 surface != nullptr ? surface->table() : no_volume_,
                 surface != nullptr ? surface->pool() : no_volume_,
                 surface != nullptr ? surface->params() : VolumeParams{}, all);
}

void ParticleSimulation::advance(float dt_s, const TsdfVolume* surface) {
    if (count_ == 0) return;
    time_left_s_ += dt_s;
    const int due = static_cast<int>(time_left_s_ / config_.substep_s);
    time_left_s_ -= static_cast<float>(due) * config_.substep_s;
    for (int i = 0; i < std::min(due, config_.most_substeps); ++i) substep(surface);
}

std::vector<Particle> ParticleSimulation::particles() const {
    std::vector<Particle> found(static_cast<std::size_t>(count_));
    if (found.empty()) return found;
    const auto values = moving_.state.map_read();
    const auto ids = moving_.ids.map_read();
    for (std::size_t i = 0; i < found.size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto at = static_cast<Eigen::Index>(axis);
            found[i].position_m[at] = values[axis * moving_.plane + i];
            found[i].velocity[at] = values[(3 + axis) * moving_.plane + i];
        }
        found[i].id = ids[i];
    }
    std::ranges::sort(found, {}, &Particle::id);
    return found;
}

}  // namespace touchstone
