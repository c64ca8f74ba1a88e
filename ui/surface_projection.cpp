#include "ui/surface_projection.hpp"

#include <array>
#include <cmath>

#include "ui/shader.hpp"

namespace touchstone {

namespace {

using Eigen::Vector2f;
using Projection = Eigen::Matrix<float, 3, 4>;
using Wide = Eigen::Matrix<double, 3, 4>;  // what is 50 m away wants more digits than a float has

constexpr std::array<std::string_view, 1> sparing_hands{"SPARES_HANDS"};
constexpr float nearest = 0.05f, farthest = 100.f;  // of depths
constexpr float no_edge = 1e30f;

Projection pixels_of(const Intrinsics& k, const RigidTransform& T_g_v) {
    const Wide T_v_g = T_g_v.cast<double>().inverse(Eigen::Isometry).matrix().topRows<3>();
    Eigen::Matrix3d K;
    K << k.fx_px, 0.0, k.cx_px, 0.0, k.fy_px, k.cy_px, 0.0, 0.0, 1.0;
    return Wide(K * T_v_g).cast<float>();
}

/// Depth is that of the plane's middle: 1 there.
Projection pixels_of_plane(const ProjectorModel& model) {
    const auto row = [&](const Eigen::Vector3f& axis) {
        const Eigen::Vector3d scaled = axis.cast<double>() / axis.cast<double>().squaredNorm();
        return Eigen::RowVector4d(scaled.x(), scaled.y(), scaled.z(),
                                  -scaled.dot(model.plane_g.origin_c_m.cast<double>()));
    };
    Wide uv_of_point;
    uv_of_point << row(model.plane_g.axis_u_c_m), row(model.plane_g.axis_v_c_m), 0.0, 0.0, 0.0, 1.0;
    const Eigen::Matrix3d H = model.H_px_uv.cast<double>();
    const double middle = (H * Eigen::Vector3d(0.5, 0.5, 1.0)).z();
    return Wide(H * uv_of_point / middle).cast<float>();
}

/// How far from its axis a lens maps farther out to farther out: where r (1 + k1 r^2 + k2 r^4) has its first
/// maximum. Beyond it Brown's model would bring points back into the picture.
float lens_edge(const std::array<float, 4>& distortion) {
    const double a = 5.0 * double{distortion[1]}, b = 3.0 * double{distortion[0]};
    const double root = b * b - 4.0 * a;
    if (root < 0.0) return no_edge;
    // The smaller positive solution of a s^2 + b s + 1 = 0, s = r^2, in a form that stands a = 0.
    const double below = -b + std::sqrt(root);
    return below > 1e-9 ? static_cast<float>(std::sqrt(2.0 / below)) : no_edge;
}

void set_projector(const GlProgram& program, const ProjectorModel& model, const Projection& to_projector) {
    const bool pinhole = model.kind == ProjectorModelKind::pinhole;
    const Vector2f focal_px = pinhole ? model.focal_px : Vector2f(1.f, 1.f);
    const Vector2f center_px = pinhole ? model.center_px : Vector2f(0.f, 0.f);
    const auto width = static_cast<float>(model.width_px), height = static_cast<float>(model.height_px);
    const std::array<float, 4> k = pinhole ? model.distortion : std::array<float, 4>{};
    glUniformMatrix4x3fv(program.uniform("u_projector"), 1, GL_FALSE, to_projector.data());
    glUniform4f(program.uniform("u_distortion"), k[0], k[1], k[2], k[3]);
    glUniform1f(program.uniform("u_lens_edge"), lens_edge(k));
    glUniform2f(program.uniform("u_scale"), 2.f * focal_px.x() / width, -2.f * focal_px.y() / height);
    glUniform2f(program.uniform("u_offset"), 2.f * (center_px.x() + 0.5f) / width - 1.f,
                1.f - 2.f * (center_px.y() + 0.5f) / height);
    glUniform2f(program.uniform("u_range"), nearest, farthest);
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
        glUniform1i(program->uniform("u_background"), 1);
    }
}

void SurfaceProjection::set_mapping(const ProjectorModel& model, const ViewFromAbove& view,
                                    const SurfaceGrid* surface) {
    const bool knows_surface = surface && model.kind == ProjectorModelKind::pinhole;
    if (!knows_surface) {
        upload(make_flat_mesh(view.area_g));
        version_.reset();
    } else if (version_ != surface->version) {
        upload(make_projection_mesh(*surface));
        version_ = surface->version;
    }
    model_ = model;
    view_size_ = view.size_px();
    to_view_ = pixels_of(view.intrinsics, view.T_g_v);
    to_projector_ = model.kind == ProjectorModelKind::pinhole ? Projection(model.T_p_g.matrix().topRows<3>())
                                                              : pixels_of_plane(model);
}

void SurfaceProjection::upload(const ProjectionMesh& mesh) {
    const auto bytes = [](const auto& list) { return static_cast<GLsizeiptr>(list.size() * sizeof list[0]); };
    glBindVertexArray(vertex_array_.id());
    glBindBuffer(GL_ARRAY_BUFFER, corner_buffer_.id());
    glBufferData(GL_ARRAY_BUFFER, bytes(mesh.corners_g_m), mesh.corners_g_m.data(), GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, index_buffer_.id());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, bytes(mesh.triangles), mesh.triangles.data(), GL_STATIC_DRAW);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Eigen::Vector3f), nullptr);
    glEnableVertexAttribArray(0);
    glBindVertexArray(0);
    corners_ = static_cast<GLsizei>(3 * mesh.triangles.size());
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
    glClearColor(0.f, 0.f, 0.f, 1.f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    if (!has_mapping()) return;
    const GlProgram& program = has_hands_ ? sparing_ : everywhere_;
    program.use();
    set_projector(program, model_, to_projector_);
    glUniformMatrix4x3fv(program.uniform("u_view"), 1, GL_FALSE, to_view_.data());
    set_size(program, "u_view_size_px", view_size_);
    picture.bind(0);
    if (has_hands_) {
        background_->bind(1);
        glUniformMatrix4x3fv(program.uniform("u_camera"), 1, GL_FALSE, to_camera_.data());
        set_size(program, "u_camera_size_px", background_->size_px());
    }
    glEnable(GL_DEPTH_TEST);
    glBindVertexArray(vertex_array_.id());
    glDrawElements(GL_TRIANGLES, corners_, GL_UNSIGNED_INT, nullptr);
    glBindVertexArray(0);
    glDisable(GL_DEPTH_TEST);
}

}  // namespace touchstone
