/* Fig 11a: millimetres to metres, bilateral filter, normal map. Vertices follow from depth: v(u) = D(u) K^-1 [u, 1]. */

/* Eight pixels a work-item; global size (pitch / 8, rows). column_shift: what is added to 1/z of each column (1/m). */
__kernel void convert_depth(__global const ushort* depth_mm, __global float* depth_m, const MapShape shape,
                            const FilterParams params, __global const float* column_shift) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1);
    float8 z = (float8)(0.0f);
    if (y < shape.height_px && x + 8 <= shape.width_px) {
        z = convert_float8(vload8(0, depth_mm + y * shape.width_px + x)) * 0.001f;
    } else if (y < shape.height_px) {
        float tail[8] = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
        for (int i = 0; x + i < shape.width_px; ++i) tail[i] = (float)depth_mm[y * shape.width_px + x + i] * 0.001f;
        z = vload8(0, tail);
    }
    z = z / (1.0f + z * vload8(0, column_shift + x));
    const int8 valid = (z >= params.min_depth_m) & (z <= params.max_depth_m);
    vstore8(select((float8)(0.0f), z, valid), 0, depth_m + y * shape.pitch_px + x);
}

INLINE float8 load_or_zero8(__global const float* row, const int x, const MapShape shape) {
    return x >= 0 && x < shape.pitch_px ? vload8(0, row + x) : (float8)(0.0f);
}

INLINE float16 load_or_zero16(__global const float* row, const int x, const MapShape shape) {
    return x >= 0 && x < shape.pitch_px ? vload16(0, row + x) : (float16)(0.0f);
}

/* The sixteen pixels from x on and their neighbours along the row, at most two pixels away. */
INLINE void load_taps16(__global const float* row, const int x, const MapShape shape, float16* taps) {
    if (x >= 16 && x + 16 < shape.pitch_px) {
        taps[0] = vload16(0, row + x - 2), taps[1] = vload16(0, row + x - 1), taps[2] = vload16(0, row + x);
        taps[3] = vload16(0, row + x + 1), taps[4] = vload16(0, row + x + 2);
        return;
    }
    const float16 a = load_or_zero16(row, x - 16, shape), b = vload16(0, row + x), c = load_or_zero16(row, x + 16, shape);
    taps[0] = (float16)(a.sef, b.s01234567, b.s89ab, b.scd);
    taps[1] = (float16)(a.sf, b.s01234567, b.s89ab, b.scd, b.se);
    taps[2] = b;
    taps[3] = (float16)(b.s1234, b.s56789abc, b.sdef, c.s0);
    taps[4] = (float16)(b.s2345, b.s6789abcd, b.sef, c.s01);
}

/* Weight (1 - e/8)^8: see FilterParams. Sixteen pixels a work-item; global size (pitch / 16, rows). Depths count from the centre in
 * units of the filter's reach, in which missing ones (0) are not. Unrolled, as PoCL else keeps the taps in memory. */
__kernel void bilateral_filter(__global const float* depth_m, __global float* filtered_m, const MapShape shape,
                               const FilterParams params) {
    const int x = (int)get_global_id(0) * 16, y = (int)get_global_id(1);
    const float16 center_m = vload16(0, depth_m + y * shape.pitch_px + x);
    if (!any(center_m > 0.0f)) {
        vstore16((float16)(0.0f), 0, filtered_m + y * shape.pitch_px + x);
        return;
    }
    const float16 sigma_m = (float16)(sigma_z8(params.noise, center_m.lo), sigma_z8(params.noise, center_m.hi));
    const float16 scale = fmax(0.25f / (params.range_sigmas * sigma_m), 1.0f / fmax(center_m, 1e-3f)), center = center_m * scale;
    const float per_px2 = 1.0f / (16.0f * params.spatial_sigma_px * params.spatial_sigma_px);
    float16 sum = (float16)(0.0f), weights = (float16)(0.0f);
    for (int j = max(-2, -y); j <= min(2, shape.rows_px - 1 - y); ++j) {
        const float middle = 1.0f - (float)(j * j) * per_px2;
        const float nearness[5] = {middle - 4.0f * per_px2, middle - per_px2, middle, middle - per_px2, middle - 4.0f * per_px2};
        float16 taps[5];
        load_taps16(depth_m + (y + j) * shape.pitch_px, x, shape, taps);
#pragma unroll
        for (int i = 0; i < 5; ++i) {
            const float16 off = taps[i] * scale - center;
            float16 w = fmax(nearness[i] - off * off, 0.0f);
            w *= w;
            w *= w;
            w *= w;
            sum += w * off;
            weights += w;
        }
    }
    const float16 filtered = center_m + sum / (fmax(weights, 1e-6f) * scale);
    vstore16(select((float16)(0.0f), filtered, center_m > 0.0f), 0, filtered_m + y * shape.pitch_px + x);
}

/* The difference of the neighbours on one axis, or of one neighbour and the pixel where the other is missing or more
 * than gap_m away. ok: -1 where there is one. */
INLINE Points8 neighbour_difference8(const Points8 before, const Points8 here, const Points8 after, const float8 gap_m,
                                     int8* ok) {
    const int8 has_before = (before.z > 0.0f) & (fabs(before.z - here.z) < gap_m);
    const int8 has_after = (after.z > 0.0f) & (fabs(after.z - here.z) < gap_m);
    *ok = has_before | has_after;
    Points8 d;
    d.x = select(here.x, after.x, has_after) - select(here.x, before.x, has_before);
    d.y = select(here.y, after.y, has_after) - select(here.y, before.y, has_before);
    d.z = select(here.z, after.z, has_after) - select(here.z, before.z, has_before);
    return d;
}

/* n(u) = dv/dx x dv/dy, unit length, facing the camera; the zero vector where there is none. Three planes. */
__kernel void normal_map(__global const float* depth_m, __global float* normals_c, const MapShape shape,
                         const Intrinsics k, const float gap_per_m) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1);
    __global const float* row = depth_m + y * shape.pitch_px;
    const float8 a = load_or_zero8(row, x - 8, shape), b = vload8(0, row + x), c = load_or_zero8(row, x + 8, shape);
    const float8 up = y > 0 ? vload8(0, row - shape.pitch_px + x) : (float8)(0.0f);
    const float8 down = y + 1 < shape.rows_px ? vload8(0, row + shape.pitch_px + x) : (float8)(0.0f);
    const Points8 here = back_project8(k, x, y, b);
    const float8 gap_m = gap_per_m * b;
    int8 ok_x, ok_y;
    const Points8 du = neighbour_difference8(back_project8(k, x - 1, y, (float8)(a.s7, b.s0123, b.s456)), here,
                                             back_project8(k, x + 1, y, (float8)(b.s1234, b.s567, c.s0)), gap_m, &ok_x);
    const Points8 dv = neighbour_difference8(back_project8(k, x, y - 1, up), here, back_project8(k, x, y + 1, down),
                                             gap_m, &ok_y);
    Points8 n;
    n.x = du.y * dv.z - du.z * dv.y;
    n.y = du.z * dv.x - du.x * dv.z;
    n.z = du.x * dv.y - du.y * dv.x;
    const float8 length2 = dot8(n, n);
    const int8 ok = (b > 0.0f) & ok_x & ok_y & (length2 > 0.0f);
    float8 scale = rsqrt(select((float8)(1.0f), length2, ok));
    scale = select(scale, -scale, dot8(n, here) > 0.0f);
    scale = select((float8)(0.0f), scale, ok);
    const int plane = shape.pitch_px * shape.rows_px, at = y * shape.pitch_px + x;
    vstore8(n.x * scale, 0, normals_c + at);
    vstore8(n.y * scale, 0, normals_c + plane + at);
    vstore8(n.z * scale, 0, normals_c + 2 * plane + at);
}
