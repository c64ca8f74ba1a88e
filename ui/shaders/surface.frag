#version 310 es
precision highp float;

uniform sampler2D u_view;   // alpha 1: background, 0: moving foreground
#ifdef HAS_LAYER
uniform sampler2D u_layer;  // premultiplied; lies on the background, under the foreground
#endif
#ifdef HAS_OVERLAY
uniform sampler2D u_overlay;  // premultiplied; lies over both
#endif
uniform vec2 u_half_size_px;
uniform float u_corner_px;
uniform float u_brightness;
uniform float u_darkest_paint;
uniform vec3 u_backdrop;

in vec2 v_uv;
in vec2 v_from_center_px;

out vec4 color;

// Paint is as bright as the surface under it, so that shape shows through, but never dull: white keeps its colour.
float shade_of_paint(vec3 surface) {
    return min(1.0, u_darkest_paint + 0.70 * dot(surface, vec3(0.299, 0.587, 0.114)));
}

void main() {
    vec4 view = texture(u_view, v_uv);
    vec3 painted = view.rgb;
#ifdef HAS_LAYER
    vec4 layer = texture(u_layer, v_uv) * view.a;
    painted = painted * (1.0 - layer.a) + layer.rgb * shade_of_paint(view.rgb);
#endif
#ifdef HAS_OVERLAY
    vec4 over = texture(u_overlay, v_uv);
    painted = painted * (1.0 - over.a) + over.rgb;
#endif
    vec2 beyond = max(abs(v_from_center_px) - u_half_size_px + u_corner_px, 0.0);
    float inside = clamp(u_corner_px - length(beyond) + 0.5, 0.0, 1.0);
    color = vec4(mix(u_backdrop, painted * u_brightness, inside), 1.0);
}
