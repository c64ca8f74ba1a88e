/* How much each pixel's depth counts in Listing 2: 0 = not at all, else 1 to `most`, proportional to the inverse variance. */

INLINE float8 load_or_zero8(__global const float* row, const int x, const MapShape shape) {
    return x >= 0 && x < shape.pitch_px ? vload8(0, row + x) : (float8)(0.0f);
}

/* Between the two sides of a depth edge, on neither of them: one neighbour is nearer by the gap, the other farther. */
INLINE int8 flies8(const float8 before, const float8 here, const float8 after, const float8 gap_m) {
    const int8 falls = (before < here - gap_m) & (after > here + gap_m);
    const int8 rises = (before > here + gap_m) & (after < here - gap_m);
    return (falls | rises) & (before > 0.0f) & (after > 0.0f);
}

/* Variance of the depth relative to that of a surface at the reference depth that faces the camera. */
INLINE float8 relative_variance8(const SampleWeightParams params, const float8 z, const float8 cos_theta) {
    const float8 cos2 = fmax(cos_theta * cos_theta, 0.01f);
    // 2 tan^2 stands for (theta / (pi/2 - theta))^2.
    const float8 sigma_m = sigma_z8(params.noise, z) + params.noise.grazing * rsqrt(z) * 2.0f * (1.0f - cos2) / cos2;
    const float8 ratio = sigma_m / params.reference_sigma_m;
    return ratio * ratio;
}

/* Eight pixels a work-item; global size (pitch / 8, rows). Pixels without a normal (thin things, borders) weigh 1. */
__kernel void sample_weights(__global const float* depth_m, __global const float* normals_c, __global const uchar* mask,
                             __global uchar* weights, const MapShape shape, const Intrinsics k, const SampleWeightParams params) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1);
    const int at = y * shape.pitch_px + x, plane = shape.pitch_px * shape.rows_px;
    __global const float* row = depth_m + y * shape.pitch_px;
    const float8 z = vload8(0, row + x);
    const int8 measured = (z > 0.0f) & (convert_int8(vload8(0, mask + at)) == 0);
    if (!any(measured)) {
        vstore8((uchar8)(0), 0, weights + at);
        return;
    }
    const float8 left = load_or_zero8(row, x - 8, shape), right = load_or_zero8(row, x + 8, shape);
    const float8 up = y > 0 ? vload8(0, row - shape.pitch_px + x) : (float8)(0.0f);
    const float8 down = y + 1 < shape.rows_px ? vload8(0, row + shape.pitch_px + x) : (float8)(0.0f);
    const float8 gap_m = params.gap_per_m * z;
    const int8 flying = flies8((float8)(left.s7, z.s0123, z.s456), z, (float8)(z.s1234, z.s567, right.s0), gap_m) |
                        flies8(up, z, down, gap_m);
    const Points8 n = {vload8(0, normals_c + at), vload8(0, normals_c + plane + at), vload8(0, normals_c + 2 * plane + at)};
    const int8 has_normal = dot8(n, n) > 0.5f;
    const Points8 ray = pixel_rays8(k, x, y);
    const float8 facing = -dot8(n, ray), length = sqrt(dot8(ray, ray));
    const int8 grazing = has_normal & (facing < params.min_cos * length);
    float8 weight = (float8)(1.0f);
    if (params.most > 1) {
        const float8 most = (float8)((float)params.most);
        const float8 by_noise = most / relative_variance8(params, fmax(z, 0.01f), facing / length);
        weight = clamp(select((float8)(1.0f), by_noise, has_normal), (float8)(1.0f), most);
    }
    const float8 used = select((float8)(0.0f), weight, measured & ~flying & ~grazing);
    vstore8(convert_uchar8(convert_int8_rte(used)), 0, weights + at);
}
