#version 310 es
precision highp float;

uniform highp usampler2D u_points;  // that each pixel lights, in the scan's frame: lit_point.frag
uniform sampler2D u_picture;        // the view from above
uniform mat4x3 u_view;              // of the scan's points to its pixels, times depth
uniform vec2 u_view_size_px;
#ifdef SPARES_HANDS
uniform sampler2D u_background;  // of the depth camera's picture: 1 background, 0 a hand
uniform mat4x3 u_camera;         // of the scan's points to its pixels, times depth
uniform vec2 u_camera_size_px;
#endif

out vec4 color;

const int most_samples = 4;     // each way
const float least_px = 1.1;     // what covers less is one sample, without a loop: a software GL is slow at those
const float widest_px = 12.0;   // what covers more lies across an edge of the surface

// Shares of a picture whose pixels have their centres at whole numbers.
vec2 place_of(vec3 point_g, mat4x3 camera, vec2 size_px) {
    vec3 p = camera * vec4(point_g, 1.0);
    return (p.xy / p.z + 0.5) / size_px;
}

// The mean over what a pixel of the projector covers: as many samples as it covers pixels.
vec3 covered(vec2 uv, vec2 across, vec2 down) {
    float footprint_px = max(length(across * u_view_size_px), length(down * u_view_size_px));
    if (footprint_px < least_px || footprint_px > widest_px) return textureLod(u_picture, uv, 0.0).rgb;
    int n = min(int(ceil(footprint_px)), most_samples);
    vec3 sum = vec3(0.0);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            vec2 off = (vec2(x, y) + 0.5) / float(n) - 0.5;
            sum += textureLod(u_picture, uv + off.x * across + off.y * down, 0.0).rgb;
        }
    return sum / float(n * n);
}

void main() {
    uvec4 texel = texelFetch(u_points, ivec2(gl_FragCoord.xy), 0);
    vec3 point_g = uintBitsToFloat(texel.xyz);
    vec2 uv = place_of(point_g, u_view, u_view_size_px);
    uv.y = 1.0 - uv.y;
    vec2 across = dFdx(uv), down = dFdy(uv);
    color = vec4(0.0, 0.0, 0.0, 1.0);
    if (texel.w == 0u || any(lessThan(uv, vec2(0.0))) || any(greaterThan(uv, vec2(1.0)))) return;
    color.rgb = covered(uv, across, down);
#ifdef SPARES_HANDS
    float background = textureLod(u_background, place_of(point_g, u_camera, u_camera_size_px), 0.0).r;
    color.rgb *= smoothstep(0.5, 1.0, background);
#endif
}
