#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "pipeline/scene_wish.hpp"
#include "platform/display/gl_program.hpp"
#include "platform/display/gl_texture.hpp"
#include "ui/mesh_model.hpp"

namespace touchstone {

/// Fig 12 a, b: polygons drawn off-screen by GL into maps of depth, normals and colours, read back for the
/// raycaster. In bytes, which every GL ES 3 can draw into: depth in 24 bits over 8 m, normals to half a
/// degree.
class MeshRasteriser {
  public:
    /// The model is kept on the GPU. Throws Error{unavailable} where the driver cannot draw into the maps.
    MeshRasteriser(const MeshModel& model, const Intrinsics& intrinsics);

    /// `T_v_m` takes the model, `scale_m` high, to the view. Parts nearer than 5 cm or beyond 8 m are cut
    /// off.
    std::shared_ptr<const MeshPicture> draw(const RigidTransform& T_v_m, float scale_m);

  private:
    struct Box {
        int x, y, width, height;
    };
    void draw_maps(const RigidTransform& T_v_m, float scale_m);
    Box box_of(const RigidTransform& T_v_m, float scale_m) const;
    std::vector<std::uint8_t> read(int map, const Box& box) const;

    Intrinsics intrinsics_;
    std::vector<Eigen::Vector3f> positions_;
    GLsizei indices_ = 0;
    GlProgram program_;
    GlVertexArrayHandle vertex_array_{new_gl_vertex_array()};
    GlBufferHandle corner_buffer_{new_gl_buffer()}, index_buffer_{new_gl_buffer()};
    GlTexture depth_map_, normal_map_, color_map_;
    GlRenderbufferHandle depth_buffer_{new_gl_renderbuffer()};
    GlFramebufferHandle framebuffer_{new_gl_framebuffer()};
};

}  // namespace touchstone
