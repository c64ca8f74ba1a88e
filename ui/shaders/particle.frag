#version 310 es
precision highp float;

uniform highp sampler2D u_real;  // millimetres of the nearest real surface: red + 256 green; 0 unknown
uniform float u_real_px_per_px;
uniform float u_radius_m;
uniform vec3 u_light;  // towards the light, y down, z towards the camera

flat in vec4 v_disc;
flat in vec4 v_color;
in vec2 v_at_px;

out vec4 color;

const float surface_noise_m = 0.004;

float real_m() {
    ivec2 pixel = clamp(ivec2(v_at_px * u_real_px_per_px), ivec2(0), textureSize(u_real, 0) - 1);
    vec2 bytes = texelFetch(u_real, pixel, 0).rg * 255.0;
    return 0.001 * (bytes.r + 256.0 * bytes.g);
}

void main() {
    vec2 from_middle = (v_at_px - v_disc.xy) / v_disc.z;
    float square = dot(from_middle, from_middle), real = real_m();
    bool is_shadow = v_color.a < 1.0;
    if (is_shadow) {
        // It lies on the surface, and not on what is above that.
        if (square > 1.0 || (real > 0.0 && real < v_disc.w - 2.0 * u_radius_m)) discard;
        color = vec4(0.0, 0.0, 0.0, v_color.a * (1.0 - square));
        return;
    }
    float cover = clamp((1.0 - sqrt(square)) * v_disc.z + 0.5, 0.0, 1.0);
    vec3 normal = vec3(from_middle, sqrt(max(1.0 - square, 0.0)));
    if (cover <= 0.0 || (real > 0.0 && real + surface_noise_m < v_disc.w - u_radius_m * normal.z)) discard;
    float diffuse = max(dot(normal, u_light), 0.0);
    float shine = pow(max(2.0 * diffuse * normal.z - u_light.z, 0.0), 24.0);
    color = vec4(min(v_color.rgb * (0.38 + 0.72 * diffuse) + 0.45 * shine, 1.0) * cover, cover);
}
