/* A view of half the columns and rows over the whole picture: each pixel four times. Sixteen pixels a work-item. */
__kernel void spread_view(__global const uint* half_rgba, __global const float* half_m, __global uint* rgba,
                          __global float* depth_m, const MapShape half_shape, const MapShape shape) {
    const int x = (int)get_global_id(0) * 16, y = (int)get_global_id(1), at = y * shape.pitch_px + x;
    const int from = (y >> 1) * half_shape.pitch_px + (x >> 1);
    const int16 column = convert_int16(lanes16()) + x;
    const int16 in_picture = (column < shape.width_px) & (int16)(y < shape.height_px ? -1 : 0);
    const uint8 colour = vload8(0, half_rgba + from);
    const float8 z = vload8(0, half_m + from);
    vstore16((uint16)(colour.s0011, colour.s2233, colour.s4455, colour.s6677), 0, rgba + at);
    vstore16(select((float16)(0.0f), (float16)(z.s0011, z.s2233, z.s4455, z.s6677), in_picture), 0, depth_m + at);
}
