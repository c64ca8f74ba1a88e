/* Things that were put down lie over the background's prediction without changing the background. */

/* Takes the nearer of both surfaces, in place. Eight pixels a work-item; global size (width / 8, height) of a rectangle of the
 * map that starts at (origin_x, origin_y), origin_x a multiple of 8. Doing it twice changes nothing. */
__kernel void lay_over(__global const float* over_m, __global const float* over_normals_c, __global float* depth_m,
                       __global float* normals_c, const int origin_x, const int origin_y, const MapShape shape) {
    const int x = origin_x + (int)get_global_id(0) * 8, y = origin_y + (int)get_global_id(1);
    const int at = y * shape.pitch_px + x, plane = shape.pitch_px * shape.rows_px;
    const float8 over = vload8(0, over_m + at), under = vload8(0, depth_m + at);
    const int8 taken = (over > 0.0f) & ((under <= 0.0f) | (over < under));
    if (!any(taken)) return;
    vstore8(select(under, over, taken), 0, depth_m + at);
    for (int axis = 0; axis < 3; ++axis) {
        const int i = axis * plane + at;
        vstore8(select(vload8(0, normals_c + i), vload8(0, over_normals_c + i), taken), 0, normals_c + i);
    }
}
