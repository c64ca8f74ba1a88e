#version 310 es
precision highp float;

uniform sampler2D u_layer;

in vec2 v_uv;

out vec4 color;

void main() { color = texture(u_layer, v_uv); }
