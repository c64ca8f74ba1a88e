#version 310 es

// A point of the lit surface as the projector throws it.
layout(location = 0) in vec3 a_point_g;

uniform mat4x3 u_projector;  // of the scan's points: into the projector's frame, or, of a plane, its pixels times depth
uniform vec4 u_distortion;   // k1, k2, p1, p2 (Brown)
uniform float u_lens_edge;   // distance from the axis beyond which Brown's polynomial would turn back inwards
uniform vec2 u_scale;        // of distorted places to normalised device coordinates
uniform vec2 u_offset;
uniform vec2 u_range;        // of depths

out vec3 v_point_g;

vec2 distorted(vec2 p) {
    float r2 = dot(p, p), xy = p.x * p.y;
    vec2 tangential = 2.0 * xy * u_distortion.zw + u_distortion.wz * (r2 + 2.0 * p * p);
    return p * (1.0 + r2 * (u_distortion.x + r2 * u_distortion.y)) + tangential;
}

vec2 seen_through_lens(vec2 p) {
    float within = min(1.0, u_lens_edge / max(length(p), 1e-6));
    return distorted(p * within) / within;
}

void main() {
    v_point_g = a_point_g;
    vec3 p = u_projector * vec4(a_point_g, 1.0);
    vec2 place = u_scale * seen_through_lens(p.xy / p.z) + u_offset;
    float depth = (u_range.y + u_range.x) / (u_range.y - u_range.x) * p.z -
                  2.0 * u_range.x * u_range.y / (u_range.y - u_range.x);
    gl_Position = vec4(place * p.z, depth, p.z);
}
