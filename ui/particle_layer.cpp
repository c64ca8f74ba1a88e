#include "ui/particle_layer.hpp"

#include "ui/shader.hpp"
#include "ui/style.hpp"

namespace touchstone {

namespace {

constexpr int layer_px_per_view_px = 2;
constexpr float shadow_radii = 1.7f;  // of a sphere: soft
constexpr float darkest = 0.5f;
constexpr int ids_per_color = 7;  // poured together, in one colour

float to_layer(float view_px) { return (view_px + 0.5f) * layer_px_per_view_px; }

std::array<float, 4> disc_of(const Intrinsics& k, const Eigen::Vector3f& middle_c_m, float radius_m) {
    const float z_m = middle_c_m.z();
    return {to_layer(k.fx_px * middle_c_m.x() / z_m + k.cx_px),
            to_layer(k.fy_px * middle_c_m.y() / z_m + k.cy_px),
            layer_px_per_view_px * k.fx_px * radius_m / z_m, z_m};
}

}  // namespace

ParticleLayer::ParticleLayer(PixelSize view)
    : program_(make_program("particle")),
      picture_({view.width_px * layer_px_per_view_px, view.height_px * layer_px_per_view_px}),
      real_(view) {
    program_.use();
    glUniform2f(program_.uniform("u_layer_size_px"), static_cast<float>(picture_.size_px().width_px),
                static_cast<float>(picture_.size_px().height_px));
    glUniform1f(program_.uniform("u_real_px_per_px"), 1.0f / layer_px_per_view_px);
    glUniform1i(program_.uniform("u_real"), 0);
    glUniform3f(program_.uniform("u_light"), -0.45f, -0.60f, 0.66f);
    draw(nullptr);
}

void ParticleLayer::upload_depth(const ParticleView& particles) {
    texels_.clear();
    for (const std::uint16_t depth_mm : particles.depth_mm)
        texels_.insert(texels_.end(), {static_cast<std::uint8_t>(depth_mm & 0xff),
                                       static_cast<std::uint8_t>(depth_mm >> 8), 0, 255});
    real_.upload(texels_);
}

void ParticleLayer::list(const ParticleView& particles) {
    instances_.clear();
    for (const ParticleSphere& sphere : particles.spheres) {
        if (sphere.shadow <= 0.0f || sphere.shadow_c_m.z() <= 0.0f) continue;
        const style::Color shade = style::shadow.faded(darkest * sphere.shadow);
        instances_.push_back(
            {disc_of(particles.intrinsics, sphere.shadow_c_m, shadow_radii * particles.radius_m),
             shade.packed()});
    }
    for (const ParticleSphere& sphere : particles.spheres) {
        if (sphere.centre_c_m.z() <= 0.0f) continue;
        instances_.push_back({disc_of(particles.intrinsics, sphere.centre_c_m, particles.radius_m),
                              style::finger_color(sphere.id / ids_per_color).packed()});
    }
}

void ParticleLayer::draw(const ParticleView* particles) {
    picture_.bind();
    glClearColor(0.f, 0.f, 0.f, 0.f);
    glClear(GL_COLOR_BUFFER_BIT);
    if (particles == nullptr || particles->spheres.empty()) return;
    upload_depth(*particles);
    list(*particles);
    program_.use();
    glUniform1f(program_.uniform("u_radius_m"), particles->radius_m);
    real_.bind(0);
    quads_.draw(instances_);
}

}  // namespace touchstone
