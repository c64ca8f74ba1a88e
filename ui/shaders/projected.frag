#version 310 es
precision highp float;

uniform sampler2D u_picture;  // the view from above
uniform mat4x3 u_view;        // of the scan's points to its pixels, times depth
uniform vec2 u_view_size_px;
#ifdef SPARES_HANDS
uniform sampler2D u_background;  // of the depth camera's picture: 1 background, 0 a hand
uniform mat4x3 u_camera;         // of the scan's points to its pixels, times depth
uniform vec2 u_camera_size_px;
#endif

in vec3 v_point_g;

out vec4 color;

const int most_samples = 4;  // each way

// Pixel centres at whole numbers.
vec2 place_of(mat4x3 camera) {
    vec3 p = camera * vec4(v_point_g, 1.0);
    return p.xy / p.z + 0.5;
}

// The mean over what a pixel of the projector covers: as many samples as it covers pixels.
vec3 covered(vec2 uv, vec2 across, vec2 down) {
    float footprint_px = max(length(across * u_view_size_px), length(down * u_view_size_px));
    int n = clamp(int(ceil(footprint_px - 0.1)), 1, most_samples);
    vec3 sum = vec3(0.0);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            vec2 off = (vec2(x, y) + 0.5) / float(n) - 0.5;
            sum += textureLod(u_picture, uv + off.x * across + off.y * down, 0.0).rgb;
        }
    return sum / float(n * n);
}

void main() {
    vec2 uv = place_of(u_view) / u_view_size_px;
    uv.y = 1.0 - uv.y;
    vec2 across = dFdx(uv), down = dFdy(uv);
    color = vec4(0.0, 0.0, 0.0, 1.0);
    if (any(lessThan(uv, vec2(0.0))) || any(greaterThan(uv, vec2(1.0)))) return;
    color.rgb = covered(uv, across, down);
#ifdef SPARES_HANDS
    float background = textureLod(u_background, place_of(u_camera) / u_camera_size_px, 0.0).r;
    color.rgb *= smoothstep(0.5, 1.0, background);
#endif
}
