#version 310 es
precision highp float;

uniform float u_radius_px;

flat in vec2 v_a_px;
flat in vec2 v_along_px;
flat in vec4 v_color;
in vec2 v_at_px;

out vec4 color;

void main() {
    vec2 from_a = v_at_px - v_a_px;
    float t = clamp(dot(from_a, v_along_px) / max(dot(v_along_px, v_along_px), 1e-6), 0.0, 1.0);
    float cover = clamp(u_radius_px + 0.5 - length(from_a - t * v_along_px), 0.0, 1.0);
    color = v_color * cover;
}
