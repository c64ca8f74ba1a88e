#version 310 es

// Corners of the view on the display, in normalised device coordinates: left, top, right, bottom.
uniform vec4 u_rect;
uniform vec2 u_half_size_px;

out vec2 v_uv;
out vec2 v_from_center_px;

void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    v_uv = corner;
    v_from_center_px = (2.0 * corner - 1.0) * u_half_size_px;
    gl_Position = vec4(mix(u_rect.xy, u_rect.zw, corner), 0.0, 1.0);
}
