#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "platform/display/gl_program.hpp"
#include "platform/display/gl_texture.hpp"
#include "ui/lit_points.hpp"
#include "ui/view_from_above.hpp"

namespace touchstone {

/// Draws a view from above as a projector has to throw it, so that it lands on the surface where it belongs.
/// What a projector lights beyond the view stays black, and what of the surface is not known.
class SurfaceProjection {
  public:
    SurfaceProjection();

    /// A pinhole lights the surface, or without one the view's area; a homography knows the area only. A
    /// surface is taken to the GPU again only when it has another version.
    void set_mapping(const ProjectorModel& model, const ViewFromAbove& view, const SurfaceGrid* surface);
    bool has_mapping() const { return has_mapping_; }
    /// What the depth camera sees in front of the surface gets no light: the moving foreground of its view.
    void set_hands(const ShadedView& seen, const Intrinsics& intrinsics, const RigidTransform& T_g_c);
    void forget_hands() { has_hands_ = false; }

    /// Before each frame, with the size of the projector's picture: true when another picture is bound now.
    bool prepare(PixelSize projector) { return points_.update(projector); }
    /// Into all of the bound picture.
    void draw(const GlTexture& picture) const;

  private:
    using Projection = Eigen::Matrix<float, 3, 4>;  // of the scan's points, to pixels times depth

    GlProgram everywhere_, sparing_;
    GlVertexArrayHandle vertex_array_{new_gl_vertex_array()};
    LitPoints points_;
    std::optional<int> surface_version_;  // of the surface that is on the GPU
    Projection to_view_, to_camera_;
    PixelSize view_size_;
    bool has_mapping_ = false, has_hands_ = false;
    std::optional<GlTexture> background_;
    std::vector<std::uint8_t> texels_;
};

}  // namespace touchstone
