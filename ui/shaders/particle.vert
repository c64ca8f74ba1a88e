#version 310 es

// One instance is a sphere as the camera sees it, or the shadow of one: a disc about its middle. Pixels of the layer, y down.
layout(location = 0) in vec4 a_disc;   // middle, radius in layer pixels; depth of the middle in metres
layout(location = 1) in vec4 a_color;  // alpha below 1: a shadow that dark

uniform vec2 u_layer_size_px;

flat out vec4 v_disc;
flat out vec4 v_color;
out vec2 v_at_px;

void main() {
    vec2 corner = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1)) * 2.0 - 1.0;
    v_disc = a_disc;
    v_color = a_color;
    v_at_px = a_disc.xy + corner * (a_disc.z + 1.0);
    gl_Position = vec4(2.0 * v_at_px / u_layer_size_px - 1.0, 0.0, 1.0);
}
