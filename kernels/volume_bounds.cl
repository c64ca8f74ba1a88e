/* 1 for each live pixel that is masked (not 0) or whose point lies outside the volume's cube, 0 for the others. Eight pixels
 * a work-item. */
__kernel void mark_outside(__global const float* depth_m, __global const uchar* mask, __global uchar* outside, const MapShape shape,
                           const Intrinsics k, const Pose T_g_c, const float low_m, const float high_m) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1), at = y * shape.pitch_px + x;
    const Points8 p = transform_points8(T_g_c, back_project8(k, x, y, vload8(0, depth_m + at)));
    const int8 inside = (p.x >= low_m) & (p.y >= low_m) & (p.z >= low_m) & (p.x <= high_m) & (p.y <= high_m) & (p.z <= high_m);
    const int8 taken = inside & (convert_int8(vload8(0, mask + at)) == 0);
    vstore8(convert_uchar8(select((int8)(1), (int8)(0), taken)), 0, outside + at);
}
