#version 310 es

// A sphere as the camera sees it: a point about its middle. Pixels of the view, y down.
layout(location = 0) in vec4 a_disc;   // middle, radius in layer pixels; depth of the middle in metres
layout(location = 1) in vec4 a_color;

uniform vec2 u_layer_size_px;

flat out vec4 v_disc;
flat out vec4 v_color;

void main() {
    v_disc = a_disc;
    v_color = a_color;
    gl_PointSize = 2.0 * a_disc.z + 1.0;
    gl_Position = vec4(2.0 * a_disc.xy / u_layer_size_px - 1.0, 0.0, 1.0);
}
