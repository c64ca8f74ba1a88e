#version 310 es

// One instance is a piece of a stroke: a line with round caps. Pixels of the layer, y down.
layout(location = 0) in vec4 a_ends_px;
layout(location = 1) in vec4 a_color;

uniform vec2 u_layer_size_px;
uniform float u_radius_px;

flat out vec2 v_a_px;
flat out vec2 v_along_px;
flat out vec4 v_color;
out vec2 v_at_px;

void main() {
    vec2 a = a_ends_px.xy;
    vec2 along = a_ends_px.zw - a;
    float reach = u_radius_px + 1.0;
    vec2 forward = dot(along, along) > 0.0 ? normalize(along) : vec2(1.0, 0.0);
    vec2 side = vec2(-forward.y, forward.x);
    float end = float(gl_VertexID & 1);
    v_a_px = a;
    v_along_px = along;
    v_color = a_color;
    v_at_px = a + along * end + forward * (2.0 * end - 1.0) * reach + side * (2.0 * float(gl_VertexID >> 1 & 1) - 1.0) * reach;
    // Row 0 of the layer is its top: no flip here.
    gl_Position = vec4(2.0 * v_at_px / u_layer_size_px - 1.0, 0.0, 1.0);
}
