#version 310 es
precision highp float;
precision highp int;

in vec3 v_point_g;

out uvec4 point;  // floats as bits: GL ES 3.1 draws into integers, not into floats; w 1 where there is one

void main() {
    point = uvec4(floatBitsToUint(v_point_g), 1u);
}
