#version 310 es
precision highp float;

uniform highp sampler2D u_real;  // as for spheres
uniform float u_real_px_per_px;
uniform float u_radius_m;

flat in vec4 v_disc;
flat in vec4 v_color;

out vec4 color;

// It lies on the surface, and not on what is above that.
void main() {
    vec2 from_middle = (gl_FragCoord.xy - v_disc.xy) / v_disc.z;
    vec2 bytes = texelFetch(u_real, ivec2(gl_FragCoord.xy * u_real_px_per_px), 0).rg;
    float real_m = dot(bytes, vec2(0.255, 65.28));
    bool is_above = real_m > 0.0 && real_m < v_disc.w - 2.0 * u_radius_m;
    float soft = is_above ? 0.0 : max(1.0 - dot(from_middle, from_middle), 0.0);
    color = vec4(0.0, 0.0, 0.0, v_color.a * soft);
}
