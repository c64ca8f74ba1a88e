#version 310 es

layout(location = 0) in vec2 a_place;  // 0..1 over the view, y down

out vec2 v_uv;

void main() {
    v_uv = a_place;
    gl_Position = vec4(2.0 * a_place - 1.0, 0.0, 1.0);
}
