#include "ui/particle_layer.hpp"

#include <cstring>

#include "ui/shader.hpp"
#include "ui/style.hpp"

namespace touchstone {

namespace {

constexpr int layer_px_per_view_px = 2;
constexpr float shadow_radii = 1.7f;  // of a sphere: soft
constexpr float darkest = 0.5f;
constexpr int ids_per_color = 7;  // poured together, in one colour

std::array<float, 4> disc_of(const Intrinsics& k, const Eigen::Vector3f& middle_c_m, float radius_m,
                             float px_per_view_px) {
    const float z_m = middle_c_m.z();
    return {px_per_view_px * (k.fx_px * middle_c_m.x() / z_m + k.cx_px + 0.5f),
            px_per_view_px * (k.fy_px * middle_c_m.y() / z_m + k.cy_px + 0.5f),
            px_per_view_px * k.fx_px * radius_m / z_m, z_m};
}

void set_size(const GlProgram& program, PixelSize size, float px_per_view_px) {
    program.use();
    glUniform2f(program.uniform("u_layer_size_px"), static_cast<float>(size.width_px),
                static_cast<float>(size.height_px));
    glUniform1f(program.uniform("u_real_px_per_px"), 1.0f / px_per_view_px);
    glUniform1i(program.uniform("u_real"), 0);
}

void clear(const GlFramebuffer& picture) {
    picture.bind();
    glClearColor(0.f, 0.f, 0.f, 0.f);
    glClear(GL_COLOR_BUFFER_BIT);
}

}  // namespace

ParticleLayer::ParticleLayer(PixelSize view)
    : spheres_program_(make_program("particle")),
      shadows_program_(make_program("particle", "particle_shadow", {})),
      picture_({view.width_px * layer_px_per_view_px, view.height_px * layer_px_per_view_px}),
      shadow_picture_(view),
      real_(view) {
    set_size(spheres_program_, picture_.size_px(), layer_px_per_view_px);
    glUniform3f(spheres_program_.uniform("u_light"), -0.45f, -0.60f, 0.66f);
    set_size(shadows_program_, view, 1.0f);
    draw(nullptr);
}

void ParticleLayer::upload_depth(const ParticleView& particles) {
    constexpr std::uint32_t opaque = 0xff000000U;  // bytes r, g, b, a; the depth in r and g
    texels_.resize(particles.depth_mm.size() * sizeof opaque);
    for (std::size_t i = 0; i < particles.depth_mm.size(); ++i) {
        const std::uint32_t texel = opaque | particles.depth_mm[i];
        std::memcpy(&texels_[i * sizeof texel], &texel, sizeof texel);
    }
    real_.upload(texels_);
}

void ParticleLayer::list(const ParticleView& particles) {
    shadows_.clear();
    spheres_.clear();
    for (const ParticleSphere& sphere : particles.spheres) {
        if (sphere.shadow <= 0.0f || sphere.shadow_c_m.z() <= 0.0f) continue;
        const style::Color shade = style::shadow.faded(darkest * sphere.shadow);
        shadows_.push_back(
            {disc_of(particles.intrinsics, sphere.shadow_c_m, shadow_radii * particles.radius_m, 1.0f),
             shade.packed()});
    }
    for (const ParticleSphere& sphere : particles.spheres) {
        if (sphere.centre_c_m.z() <= 0.0f) continue;
        spheres_.push_back(
            {disc_of(particles.intrinsics, sphere.centre_c_m, particles.radius_m, layer_px_per_view_px),
             style::finger_color(sphere.id / ids_per_color).packed()});
    }
}

void ParticleLayer::draw(const ParticleView* particles) {
    clear(shadow_picture_);
    clear(picture_);
    if (particles == nullptr || particles->spheres.empty()) return;
    upload_depth(*particles);
    list(*particles);
    real_.bind(0);
    const auto draw_into = [&](const GlFramebuffer& picture, const GlProgram& program,
                               std::span<const QuadInstance> points) {
        picture.bind();
        program.use();
        glUniform1f(program.uniform("u_radius_m"), particles->radius_m);
        quads_.draw_points(points);
    };
    draw_into(shadow_picture_, shadows_program_, shadows_);
    draw_into(picture_, spheres_program_, spheres_);
}

}  // namespace touchstone
