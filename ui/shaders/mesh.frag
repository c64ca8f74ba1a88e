#version 310 es
precision highp float;
precision highp int;

uniform float u_units_per_m;

in vec3 v_place_m;
in vec3 v_normal;
in vec4 v_color;

layout(location = 0) out vec4 depth;   // in units, the lowest byte in red
layout(location = 1) out vec4 normal;  // towards the camera, 0..1 for -1..1
layout(location = 2) out vec4 color;

void main() {
    uint units = uint(v_place_m.z * u_units_per_m + 0.5);
    depth = vec4(units & 255u, (units >> 8) & 255u, (units >> 16) & 255u, 255u) / 255.0;
    vec3 n = normalize(v_normal);
    normal = vec4(0.5 + 0.5 * (dot(n, v_place_m) > 0.0 ? -n : n), 1.0);
    color = v_color;
}
