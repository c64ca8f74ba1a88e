#version 310 es
precision highp float;

uniform sampler2D u_picture;
uniform vec2 u_half_px;
uniform float u_border_px;
uniform float u_corner_px;
uniform float u_reach_px;    // of the shadow
uniform vec2 u_fall_px;      // where the shadow falls, along the photo's axes
uniform float u_darkness;

in vec2 v_from_center_px;

out vec4 color;

float outside_px(vec2 p, vec2 half_px, float corner_px) {
    vec2 beyond = abs(p) - half_px + corner_px;
    return length(max(beyond, 0.0)) + min(max(beyond.x, beyond.y), 0.0) - corner_px;
}

void main() {
    vec2 beyond = abs(v_from_center_px) - u_half_px;
    float cover = clamp(0.5 - max(beyond.x, beyond.y), 0.0, 1.0);
    float from_shadow = outside_px(v_from_center_px - u_fall_px, u_half_px, u_corner_px);
    float soft = 1.0 - smoothstep(-u_reach_px, u_reach_px, from_shadow);
    float shadow = u_darkness * soft * soft * (1.0 - cover);
    float inside = clamp(0.5 - max(beyond.x, beyond.y) - u_border_px, 0.0, 1.0);
    vec3 picture = texture(u_picture, 0.5 + 0.5 * v_from_center_px / (u_half_px - u_border_px)).rgb;
    color = vec4(mix(vec3(0.98), picture, inside) * cover, cover + shadow);
}
