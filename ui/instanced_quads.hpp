#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "platform/display/gl_handle.hpp"

namespace touchstone {

/// Four values and a colour for each quad: attributes 0 (vec4) and 1 (bytes r, g, b, a as 0..1) of its vertex
/// shader, which makes corners of gl_VertexID 0..3, a strip.
struct QuadInstance {
    std::array<float, 4> values;
    std::uint32_t color;
};

/// Draws many quads in one call, premultiplied over what is there, in their order.
class InstancedQuads {
  public:
    InstancedQuads();
    /// With the program in use, into the bound picture.
    void draw(std::span<const QuadInstance> quads);

  private:
    GlVertexArrayHandle vertex_array_{new_gl_vertex_array()};
    GlBufferHandle instance_buffer_{new_gl_buffer()};
};

}  // namespace touchstone
