#version 310 es
precision highp float;

uniform highp sampler2D u_real;  // millimetres of the nearest real surface: red + 256 green; 0 unknown
uniform float u_radius_m;
uniform vec3 u_light;  // towards the light, y down, z towards the camera

flat in vec4 v_disc;
flat in vec4 v_color;

out vec4 color;

const float surface_noise_m = 0.004;

float real_m() {
    vec2 bytes = texelFetch(u_real, ivec2(gl_FragCoord.xy), 0).rg;
    return dot(bytes, vec2(0.255, 65.28));
}

void main() {
    vec2 from_middle = (gl_FragCoord.xy - v_disc.xy) / v_disc.z;
    float square = dot(from_middle, from_middle), real = real_m();
    float cover = clamp((1.0 - sqrt(square)) * v_disc.z + 0.5, 0.0, 1.0);
    vec3 normal = vec3(from_middle, sqrt(max(1.0 - square, 0.0)));
    bool is_hidden = real > 0.0 && real + surface_noise_m < v_disc.w - u_radius_m * normal.z;
    cover = is_hidden ? 0.0 : cover;
    float diffuse = max(dot(normal, u_light), 0.0);
    float shine = max(2.0 * diffuse * normal.z - u_light.z, 0.0);
    shine *= shine * shine;  // to the 24th
    shine *= shine;
    shine *= shine;
    shine *= shine;
    color = vec4(min(v_color.rgb * (0.38 + 0.72 * diffuse) + 0.45 * shine, 1.0) * cover, cover);
}
