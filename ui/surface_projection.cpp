#include "ui/surface_projection.hpp"

#include <array>

#include "ui/shader.hpp"

namespace touchstone {

namespace {

constexpr std::array<std::string_view, 1> sparing_hands{"SPARES_HANDS"};

/// In doubles: what is 50 m away wants more digits than a float has.
Eigen::Matrix<float, 3, 4> pixels_of(const Intrinsics& k, const RigidTransform& T_g_v) {
    using Wide = Eigen::Matrix<double, 3, 4>;
    const Wide T_v_g = T_g_v.cast<double>().inverse(Eigen::Isometry).matrix().topRows<3>();
    Eigen::Matrix3d K;
    K << k.fx_px, 0.0, k.cx_px, 0.0, k.fy_px, k.cy_px, 0.0, 0.0, 1.0;
    return Wide(K * T_v_g).cast<float>();
}

void set_size(const GlProgram& program, const char* name, PixelSize size) {
    glUniform2f(program.uniform(name), static_cast<float>(size.width_px), static_cast<float>(size.height_px));
}

}  // namespace

SurfaceProjection::SurfaceProjection()
    : everywhere_(make_program("projected")),
      sparing_(make_program("projected", "projected", sparing_hands)) {
    for (const GlProgram* program : {&everywhere_, &sparing_}) {
        program->use();
        glUniform1i(program->uniform("u_picture"), 0);
        glUniform1i(program->uniform("u_points"), 1);
        glUniform1i(program->uniform("u_background"), 2);
    }
}

void SurfaceProjection::set_mapping(const ProjectorModel& model, const ViewFromAbove& view,
                                    const SurfaceGrid* surface) {
    const bool knows_surface = surface && model.kind == ProjectorModelKind::pinhole;
    if (!knows_surface) {
        points_.set_surface(make_flat_mesh(view.area_g));
        surface_version_.reset();
    } else if (surface_version_ != surface->version) {
        points_.set_surface(make_projection_mesh(*surface));
        surface_version_ = surface->version;
    }
    points_.set_model(model);
    view_size_ = view.size_px();
    has_mapping_ = true;
    to_view_ = pixels_of(view.intrinsics, view.T_g_v);
}

void SurfaceProjection::set_hands(const ShadedView& seen, const Intrinsics& intrinsics,
                                  const RigidTransform& T_g_c) {
    const PixelSize size{seen.width_px, seen.height_px};
    if (!background_ || background_->size_px() != size) background_.emplace(size, TexelFormat::r8);
    texels_.resize(seen.rgba.size() / 4);
    for (std::size_t i = 0; i < texels_.size(); ++i) texels_[i] = seen.rgba[4 * i + 3];
    background_->upload(texels_);
    to_camera_ = pixels_of(intrinsics, T_g_c);
    has_hands_ = true;
}

void SurfaceProjection::draw(const GlTexture& picture) const {
    const GlProgram& program = has_hands_ ? sparing_ : everywhere_;
    program.use();
    glUniformMatrix4x3fv(program.uniform("u_view"), 1, GL_FALSE, to_view_.data());
    set_size(program, "u_view_size_px", view_size_);
    picture.bind(0);
    points_.bind(1);
    if (has_hands_) {
        glUniformMatrix4x3fv(program.uniform("u_camera"), 1, GL_FALSE, to_camera_.data());
        set_size(program, "u_camera_size_px", background_->size_px());
        background_->bind(2);
    }
    glBindVertexArray(vertex_array_.id());
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    glBindVertexArray(0);
}

}  // namespace touchstone
