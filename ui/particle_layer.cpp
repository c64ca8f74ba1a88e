#include "ui/particle_layer.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "ui/shader.hpp"
#include "ui/style.hpp"

namespace touchstone {

namespace {

constexpr int shadow_step_px = 4;
constexpr float shadow_radii = 1.7f;  // of a sphere: soft
constexpr float darkest = 0.5f;
constexpr int ids_per_color = 7;  // poured together, in one colour

/// Middle and radius in pixels of the view, whose left edge is 0, and depth in metres.
std::array<float, 4> disc_of(const Intrinsics& k, const Eigen::Vector3f& middle_c_m, float radius_m) {
    const Eigen::Vector2f middle_px = project(k, middle_c_m);
    const float z_m = middle_c_m.z();
    return {middle_px.x() + 0.5f, middle_px.y() + 0.5f, k.fx_px * radius_m / z_m, z_m};
}

}  // namespace

ParticleLayer::ParticleLayer(PixelSize view)
    : program_(make_program("particle")),
      picture_(view),
      real_(view),
      shadows_({view.width_px / shadow_step_px, view.height_px / shadow_step_px}) {
    program_.use();
    glUniform2f(program_.uniform("u_layer_size_px"), static_cast<float>(view.width_px),
                static_cast<float>(view.height_px));
    glUniform1i(program_.uniform("u_real"), 0);
    glUniform3f(program_.uniform("u_light"), -0.45f, -0.60f, 0.66f);
    draw(nullptr);
}

/// In all four bytes: a software GL reads those faster than two.
void ParticleLayer::upload_depth(const ParticleView& particles) {
    constexpr std::uint32_t opaque = 0xff000000U;  // bytes r, g, b, a; the depth in r and g
    texels_.resize(4 * static_cast<std::size_t>(real_.size_px().width_px) *
                   static_cast<std::size_t>(real_.size_px().height_px));
    if (particles.depth_mm.empty()) std::fill(texels_.begin(), texels_.end(), std::uint8_t{0});
    for (std::size_t i = 0; i < particles.depth_mm.size(); ++i) {
        const std::uint32_t texel = opaque | particles.depth_mm[i];
        std::memcpy(&texels_[i * sizeof texel], &texel, sizeof texel);
    }
    real_.upload(texels_);
}

void ParticleLayer::list_spheres(const ParticleView& particles) {
    spheres_.clear();
    for (const ParticleSphere& sphere : particles.spheres) {
        if (sphere.centre_c_m.z() <= 0.0f) continue;
        spheres_.push_back({disc_of(particles.intrinsics, sphere.centre_c_m, particles.radius_m),
                            style::finger_color(sphere.id / ids_per_color).packed()});
    }
}

/// Soft, and not on what is above the surface.
void ParticleLayer::darken(const ParticleView& particles, const ParticleSphere& sphere) {
    const PixelSize size = shadows_.size_px();
    const auto disc = disc_of(particles.intrinsics, sphere.shadow_c_m, shadow_radii * particles.radius_m);
    const float x = disc[0] / shadow_step_px, y = disc[1] / shadow_step_px, radius = disc[2] / shadow_step_px;
    const auto first = [](float from) { return std::max(0, static_cast<int>(std::floor(from))); };
    const auto last = [](float to, int size_px) {
        return std::min(size_px - 1, static_cast<int>(std::ceil(to)));
    };
    const float lifted_mm = 1000.0f * (sphere.shadow_c_m.z() - 2.0f * particles.radius_m);
    for (int v = first(y - radius); v <= last(y + radius, size.height_px); ++v) {
        for (int u = first(x - radius); u <= last(x + radius, size.width_px); ++u) {
            const float dx = static_cast<float>(u) + 0.5f - x, dy = static_cast<float>(v) + 0.5f - y;
            const float soft = 1.0f - (dx * dx + dy * dy) / (radius * radius);
            const auto real = static_cast<std::size_t>(shadow_step_px * v * particles.intrinsics.width_px +
                                                       shadow_step_px * u);
            const float real_mm = particles.depth_mm.empty() ? 0.0f : particles.depth_mm[real];
            if (soft <= 0.0f || (real_mm > 0.0f && real_mm < lifted_mm)) continue;
            std::uint8_t& alpha = shadow_texels_[4 * static_cast<std::size_t>(v * size.width_px + u) + 3];
            const float left = (255.0f - static_cast<float>(alpha)) * (1.0f - darkest * sphere.shadow * soft);
            alpha = static_cast<std::uint8_t>(255.0f - left);
        }
    }
}

void ParticleLayer::draw_shadows(const ParticleView* particles) {
    const PixelSize size = shadows_.size_px();
    shadow_texels_.assign(4 * static_cast<std::size_t>(size.width_px * size.height_px), 0);
    if (particles != nullptr) {
        for (const ParticleSphere& sphere : particles->spheres)
            if (sphere.shadow > 0.0f && sphere.shadow_c_m.z() > 0.0f) darken(*particles, sphere);
    }
    shadows_.upload(shadow_texels_);
}

void ParticleLayer::draw(const ParticleView* particles) {
    const bool fits = particles != nullptr && particles->intrinsics.width_px == picture_.size_px().width_px &&
                      particles->intrinsics.height_px == picture_.size_px().height_px;
    draw_shadows(fits ? particles : nullptr);
    picture_.bind();
    glClearColor(0.f, 0.f, 0.f, 0.f);
    glClear(GL_COLOR_BUFFER_BIT);
    if (!fits || particles->spheres.empty()) return;
    upload_depth(*particles);
    list_spheres(*particles);
    real_.bind(0);
    picture_.bind();
    program_.use();
    glUniform1f(program_.uniform("u_radius_m"), particles->radius_m);
    quads_.draw_points(spheres_);
}

}  // namespace touchstone
