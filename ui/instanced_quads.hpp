#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "platform/display/gl_handle.hpp"

namespace touchstone {

/// Four values and a colour for each quad: attributes 0 (vec4) and 1 (bytes r, g, b, a as 0..1) of its vertex
/// shader, which makes corners of gl_VertexID % 4, a strip.
struct QuadInstance {
    std::array<float, 4> values;
    std::uint32_t color;
};

enum class QuadBlend {
    over,   ///< premultiplied over what is there
    erase,  ///< what is there is taken away, by the quad's alpha
};

/// Draws many quads in one call, in their order. Each is told to GL four times: a software GL starts anew for
/// each instance, which costs more.
class InstancedQuads {
  public:
    InstancedQuads();
    /// With the program in use, into the bound picture.
    void draw(std::span<const QuadInstance> quads, QuadBlend blend = QuadBlend::over);
    /// Each as a point, for which the shader sets gl_PointSize: half the work of a quad. One whose middle is
    /// outside the picture is not drawn.
    void draw_points(std::span<const QuadInstance> quads);

  private:
    void index(std::size_t quads);

    GlVertexArrayHandle vertex_array_{new_gl_vertex_array()};
    GlBufferHandle corner_buffer_{new_gl_buffer()}, index_buffer_{new_gl_buffer()};
    std::vector<QuadInstance> corners_;
    std::size_t quads_indexed_ = 0;
};

}  // namespace touchstone
