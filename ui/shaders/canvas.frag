#version 310 es
precision mediump float;

uniform sampler2D u_letters;

in highp vec2 v_uv;
in vec4 v_color;

out vec4 color;

void main() {
    color = vec4(v_color.rgb, v_color.a * texture(u_letters, v_uv).r);
}
