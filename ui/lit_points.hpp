#pragma once

#include <optional>

#include "pipeline/projector_model.hpp"
#include "platform/display/gl_program.hpp"
#include "platform/display/picture.hpp"
#include "ui/projection_mesh.hpp"

namespace touchstone {

/// Which point of the scan each pixel of a projector lights: a picture drawn once for a surface, a model and
/// a display, so that a frame costs the same however fine the surface is.
class LitPoints {
  public:
    LitPoints();

    void set_surface(const ProjectionMesh& mesh);
    void set_model(const ProjectorModel& model);
    /// Draws the picture for a display of that size, which may be another than the model's, where something
    /// has changed: then true, and another picture is bound. Throws Error{unavailable} where the driver
    /// cannot.
    bool update(PixelSize display);
    /// RGBA32UI: x, y, z as the bits of floats, metres, and 1, or all 0.
    void bind(int unit) const;

  private:
    /// What is drawn into.
    struct Target {
        explicit Target(PixelSize picture_size);
        PixelSize size;
        GlTextureHandle points{new_gl_texture()};
        GlRenderbufferHandle depth{new_gl_renderbuffer()};
        GlFramebufferHandle framebuffer{new_gl_framebuffer()};
    };

    GlProgram program_;
    GlVertexArrayHandle vertex_array_{new_gl_vertex_array()};
    GlBufferHandle corner_buffer_{new_gl_buffer()}, index_buffer_{new_gl_buffer()};
    GLsizei corners_ = 0;  // of triangles
    std::optional<Target> target_;
    bool is_old_ = true;
};

}  // namespace touchstone
