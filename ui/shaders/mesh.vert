#version 310 es

// A model in the pixels of a camera (Fig 12 a): x right, y down, z forward; row 0 is the first that GL reads.
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec4 a_color;

uniform mat4 u_pose;     // to the camera's frame, metres; turns, moves and scales alike
uniform vec4 u_camera;   // focal lengths, and the centre from the picture's corner; pixels
uniform vec2 u_size_px;
uniform vec2 u_range_m;

out vec3 v_place_m;
out vec3 v_normal;
out vec4 v_color;

void main() {
    vec3 p = (u_pose * vec4(a_position, 1.0)).xyz;
    v_place_m = p;
    v_normal = mat3(u_pose) * a_normal;
    v_color = a_color;
    vec2 at = (2.0 * (u_camera.xy * p.xy + u_camera.zw * p.z) / u_size_px) - p.z;
    float sum = u_range_m.y + u_range_m.x, span = u_range_m.y - u_range_m.x;
    gl_Position = vec4(at, (sum * p.z - 2.0 * u_range_m.x * u_range_m.y) / span, p.z);
}
