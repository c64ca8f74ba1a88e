#version 310 es

// A photo with its shadow, turned about its middle. Pixels of the layer, y down.
uniform vec2 u_layer_size_px;
uniform vec2 u_center_px;
uniform vec2 u_turn;  // cosine and sine
uniform vec2 u_half_px;
uniform float u_reach_px;

out vec2 v_from_center_px;  // along the photo's own axes

void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    v_from_center_px = corner * (u_half_px + 2.0 * u_reach_px);
    vec2 turned = mat2(u_turn.x, u_turn.y, -u_turn.y, u_turn.x) * v_from_center_px;
    gl_Position = vec4(2.0 * (u_center_px + turned) / u_layer_size_px - 1.0, 0.0, 1.0);
}
