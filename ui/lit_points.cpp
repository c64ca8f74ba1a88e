#include "ui/lit_points.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "platform/system/error.hpp"
#include "ui/shader.hpp"

namespace touchstone {

namespace {

using Eigen::Vector2f;
using Projection = Eigen::Matrix<float, 3, 4>;  // of the scan's points, to places times depth

constexpr float nearest = 0.05f, farthest = 100.f;  // of depths

/// Depth is told by that of the plane's middle: 1 there.
Projection pixels_of_plane(const ProjectorModel& model) {
    const auto row = [&](const Eigen::Vector3f& axis) {
        const Eigen::Vector3d scaled = axis.cast<double>() / axis.cast<double>().squaredNorm();
        return Eigen::RowVector4d(scaled.x(), scaled.y(), scaled.z(),
                                  -scaled.dot(model.plane_g.origin_c_m.cast<double>()));
    };
    Eigen::Matrix<double, 3, 4> uv_of_point;
    uv_of_point << row(model.plane_g.axis_u_c_m), row(model.plane_g.axis_v_c_m), 0.0, 0.0, 0.0, 1.0;
    const Eigen::Matrix3d H = model.H_px_uv.cast<double>();
    const double middle = (H * Eigen::Vector3d(0.5, 0.5, 1.0)).z();
    return Eigen::Matrix<double, 3, 4>(H * uv_of_point / middle).cast<float>();
}

}  // namespace

LitPoints::Target::Target(PixelSize picture_size) : size(picture_size) {
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, points.id());
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32UI, size.width_px, size.height_px);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glBindRenderbuffer(GL_RENDERBUFFER, depth.id());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, size.width_px, size.height_px);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, points.id(), 0);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth.id());
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw Error(ExitStatus::unavailable, "The graphics driver cannot draw the points a projector lights");
}

LitPoints::LitPoints() : program_(make_program("lit_point")) {}

void LitPoints::set_surface(const ProjectionMesh& mesh) {
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
    is_old_ = true;
}

void LitPoints::set_model(const ProjectorModel& model) {
    const bool pinhole = model.kind == ProjectorModelKind::pinhole;
    const Projection points_to_projector =
        pinhole ? Projection(model.T_p_g.matrix().topRows<3>()) : pixels_of_plane(model);
    const Vector2f focal_px = pinhole ? model.focal_px : Vector2f(1.f, 1.f);
    const Vector2f center_px = pinhole ? model.center_px : Vector2f(0.f, 0.f);
    const std::array<float, 4> lens = pinhole ? model.distortion : std::array<float, 4>{};
    const auto width = static_cast<float>(model.width_px), height = static_cast<float>(model.height_px);
    program_.use();
    glUniformMatrix4x3fv(program_.uniform("u_projector"), 1, GL_FALSE, points_to_projector.data());
    glUniform4f(program_.uniform("u_distortion"), lens[0], lens[1], lens[2], lens[3]);
    glUniform1f(program_.uniform("u_lens_edge"), lens_edge(lens));
    glUniform2f(program_.uniform("u_scale"), 2.f * focal_px.x() / width, -2.f * focal_px.y() / height);
    glUniform2f(program_.uniform("u_offset"), 2.f * (center_px.x() + 0.5f) / width - 1.f,
                1.f - 2.f * (center_px.y() + 0.5f) / height);
    glUniform2f(program_.uniform("u_range"), nearest, farthest);
    is_old_ = true;
}

bool LitPoints::update(PixelSize display) {
    if (!is_old_ && target_ && target_->size == display) return false;
    if (!target_ || target_->size != display) target_.emplace(display);
    glBindFramebuffer(GL_FRAMEBUFFER, target_->framebuffer.id());
    glViewport(0, 0, display.width_px, display.height_px);
    constexpr std::array<GLuint, 4> nothing{0, 0, 0, 0};
    glClearBufferuiv(GL_COLOR, 0, nothing.data());
    glClear(GL_DEPTH_BUFFER_BIT);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    program_.use();
    glBindVertexArray(vertex_array_.id());
    glDrawElements(GL_TRIANGLES, corners_, GL_UNSIGNED_INT, nullptr);
    glBindVertexArray(0);
    glDisable(GL_DEPTH_TEST);
    is_old_ = false;
    return true;
}

void LitPoints::bind(int unit) const {
    glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
    glBindTexture(GL_TEXTURE_2D, target_->points.id());
}

}  // namespace touchstone
