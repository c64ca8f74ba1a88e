#include "ui/mesh_rasteriser.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "platform/system/error.hpp"
#include "ui/shader.hpp"

namespace touchstone {

namespace {

constexpr float nearest_m = 0.05f, farthest_m = 8.f;
constexpr float units_per_m = 16777215.f / farthest_m;  // of the depth map: three bytes

PixelSize size_of(const Intrinsics& k) { return {k.width_px, k.height_px}; }

}  // namespace

MeshRasteriser::MeshRasteriser(const MeshModel& model, const Intrinsics& intrinsics)
    : intrinsics_(intrinsics),
      program_(make_program("mesh")),
      depth_map_(size_of(intrinsics)),
      normal_map_(size_of(intrinsics)),
      color_map_(size_of(intrinsics)) {
    for (const MeshModel::Corner& corner : model.corners) positions_.push_back(corner.position);
    indices_ = static_cast<GLsizei>(3 * model.triangles.size());
    using Corner = MeshModel::Corner;
    const auto offset = [](std::size_t bytes) { return reinterpret_cast<const void*>(bytes); };
    const auto bytes = [](const auto& list) { return static_cast<GLsizeiptr>(list.size() * sizeof list[0]); };
    glBindVertexArray(vertex_array_.id());
    glBindBuffer(GL_ARRAY_BUFFER, corner_buffer_.id());
    glBufferData(GL_ARRAY_BUFFER, bytes(model.corners), model.corners.data(), GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, index_buffer_.id());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, bytes(model.triangles), model.triangles.data(), GL_STATIC_DRAW);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Corner), offset(offsetof(Corner, position)));
    glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, sizeof(Corner), offset(offsetof(Corner, normal)));
    glVertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(Corner), offset(offsetof(Corner, rgba)));
    for (const GLuint attribute : {0U, 1U, 2U}) glEnableVertexAttribArray(attribute);
    glBindVertexArray(0);

    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    GLenum attachment = GL_COLOR_ATTACHMENT0;
    for (const GlTexture* map : {&depth_map_, &normal_map_, &color_map_})
        glFramebufferTexture2D(GL_FRAMEBUFFER, attachment++, GL_TEXTURE_2D, map->id(), 0);
    glBindRenderbuffer(GL_RENDERBUFFER, depth_buffer_.id());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, intrinsics.width_px, intrinsics.height_px);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_buffer_.id());
    const std::array<GLenum, 3> targets{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2};
    glDrawBuffers(3, targets.data());
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw Error(ExitStatus::unavailable, "The graphics driver cannot draw models into maps");

    program_.use();
    const Intrinsics& k = intrinsics_;
    glUniform4f(program_.uniform("u_camera"), k.fx_px, k.fy_px, k.cx_px + 0.5f, k.cy_px + 0.5f);
    glUniform2f(program_.uniform("u_size_px"), static_cast<float>(k.width_px),
                static_cast<float>(k.height_px));
    glUniform2f(program_.uniform("u_range_m"), nearest_m, farthest_m);
    glUniform1f(program_.uniform("u_units_per_m"), units_per_m);
}

std::shared_ptr<const MeshPicture> MeshRasteriser::draw(const RigidTransform& T_v_m, float scale_m) {
    draw_maps(T_v_m, scale_m);
    auto picture = std::make_shared<MeshPicture>();
    const auto width = static_cast<std::size_t>(intrinsics_.width_px);
    const std::size_t pixels = width * static_cast<std::size_t>(intrinsics_.height_px);
    picture->intrinsics = intrinsics_;
    picture->depth_m.assign(pixels, 0.f);
    picture->normals_c.assign(3 * pixels, 0.f);
    picture->rgba.assign(pixels, 0);
    const Box box = box_of(T_v_m, scale_m);
    if (box.width <= 0 || box.height <= 0) return picture;
    const std::vector<std::uint8_t> depth = read(0, box), normal = read(1, box), color = read(2, box);
    std::size_t byte = 0;
    for (int y = box.y; y < box.y + box.height; ++y) {
        for (int x = box.x; x < box.x + box.width; ++x, byte += 4) {
            const std::uint32_t units = depth[byte] | static_cast<std::uint32_t>(depth[byte + 1]) << 8 |
                                        static_cast<std::uint32_t>(depth[byte + 2]) << 16;
            if (units == 0) continue;
            const auto at = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
            picture->depth_m[at] = static_cast<float>(units) / units_per_m;
            const Eigen::Vector3f n = Eigen::Vector3f(static_cast<float>(normal[byte]) - 127.5f,
                                                      static_cast<float>(normal[byte + 1]) - 127.5f,
                                                      static_cast<float>(normal[byte + 2]) - 127.5f)
                                          .normalized();
            for (std::size_t plane = 0; plane < 3; ++plane)
                picture->normals_c[plane * pixels + at] = n[static_cast<Eigen::Index>(plane)];
            picture->rgba[at] = color[byte] | static_cast<std::uint32_t>(color[byte + 1]) << 8 |
                                static_cast<std::uint32_t>(color[byte + 2]) << 16 | 0xff000000U;
        }
    }
    return picture;
}

void MeshRasteriser::draw_maps(const RigidTransform& T_v_m, float scale_m) {
    Eigen::Matrix4f pose = T_v_m.matrix();
    pose.topLeftCorner<3, 3>() *= scale_m;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glViewport(0, 0, intrinsics_.width_px, intrinsics_.height_px);
    glClearColor(0.f, 0.f, 0.f, 0.f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    program_.use();
    glUniformMatrix4fv(program_.uniform("u_pose"), 1, GL_FALSE, pose.data());
    glBindVertexArray(vertex_array_.id());
    glDrawElements(GL_TRIANGLES, indices_, GL_UNSIGNED_INT, nullptr);
    glBindVertexArray(0);
    glDisable(GL_DEPTH_TEST);
}

/// Of the pixels that the model can cover; all where a part is not well in front of the view.
MeshRasteriser::Box MeshRasteriser::box_of(const RigidTransform& T_v_m, float scale_m) const {
    const Intrinsics& k = intrinsics_;
    Eigen::AlignedBox2f box;
    for (const Eigen::Vector3f& position : positions_) {
        const Eigen::Vector3f p = T_v_m * (scale_m * position);
        if (p.z() < nearest_m) return {0, 0, k.width_px, k.height_px};
        box.extend(project(k, p));
    }
    if (box.isEmpty()) return {0, 0, 0, 0};
    const auto within = [](float at, int size) {
        return static_cast<int>(std::clamp(at, 0.f, static_cast<float>(size)));
    };
    const int x0 = within(std::floor(box.min().x()), k.width_px),
              y0 = within(std::floor(box.min().y()), k.height_px);
    const int x1 = within(box.max().x() + 2.f, k.width_px), y1 = within(box.max().y() + 2.f, k.height_px);
    return {x0, y0, x1 - x0, y1 - y0};
}

std::vector<std::uint8_t> MeshRasteriser::read(int map, const Box& box) const {
    std::vector<std::uint8_t> bytes(4 * static_cast<std::size_t>(box.width) *
                                    static_cast<std::size_t>(box.height));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.id());
    glReadBuffer(static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + map));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(box.x, box.y, box.width, box.height, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
    return bytes;
}

}  // namespace touchstone
