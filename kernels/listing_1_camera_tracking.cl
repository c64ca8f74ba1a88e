/* Camera tracking: Listing 1 and Eq 1 in one pass. Each live pixel finds its model pixel by projection, and what the pair
 * adds to the 6x6 system is summed on the device; no record per pixel. Every point is in the frame p of the prediction. */

/* Half the size: the mean of those of 2x2 pixels that are within gap_per_m z of the nearest. Pixel x of the result is at
 * 2 x + 0.5 of the source. Eight pixels a work-item. */
__kernel void half_sample(__global const float* source_m, __global float* half_m, const MapShape source,
                          const MapShape half_shape, const float gap_per_m) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1);
    const bool inside = 2 * x < source.pitch_px && 2 * y + 1 < source.rows_px;
    float8 result = (float8)(0.0f);
    if (inside) {
        __global const float* top = source_m + 2 * y * source.pitch_px + 2 * x;
        const float16 a = vload16(0, top), b = vload16(0, top + source.pitch_px);
        const float8 p[4] = {a.even, a.odd, b.even, b.odd};
        float8 nearest = (float8)(FLT_MAX), sum = (float8)(0.0f), count = (float8)(0.0f);
        for (int i = 0; i < 4; ++i) nearest = fmin(nearest, select((float8)(FLT_MAX), p[i], p[i] > 0.0f));
        for (int i = 0; i < 4; ++i) {
            const int8 used = (p[i] > 0.0f) & (p[i] <= nearest * (1.0f + gap_per_m));
            sum += select((float8)(0.0f), p[i], used);
            count += select((float8)(0.0f), (float8)(1.0f), used);
        }
        result = select((float8)(0.0f), sum / fmax(count, 1.0f), count > 0.0f);
        const float8 columns = lanes8() + (float)x;
        result = select((float8)(0.0f), result, (columns < (float)half_shape.width_px) & (int8)(y < half_shape.height_px ? -1 : 0));
    }
    vstore8(result, 0, half_m + y * half_shape.pitch_px + x);
}

/* Depths without those of the pixels whose mask is not 0. Eight pixels a work-item. */
__kernel void leave_out(__global const float* depth_m, __global const uchar* mask, __global float* result_m, const MapShape shape) {
    const int at = (int)get_global_id(1) * shape.pitch_px + (int)get_global_id(0) * 8;
    const int8 kept = convert_int8(vload8(0, mask + at)) == 0;
    vstore8(select((float8)(0.0f), vload8(0, depth_m + at), kept), 0, result_m + at);
}

/* Adds w J^T (J, r) of sixteen pixels, J = (p x d, d) with p from the centre of the twist. */
INLINE void add_rows16(float16* total, const Points16 p, const Points16 d, const float16 r, const float16 w) {
    const float16 j[6] = {p.y * d.z - p.z * d.y, p.z * d.x - p.x * d.z, p.x * d.y - p.y * d.x, d.x, d.y, d.z};
    int k = 0;
    // Unrolled, the sums stay in registers.
#pragma unroll
    for (int a = 0; a < 6; ++a) {
        const float16 wj = w * j[a];
#pragma unroll
        for (int b = a; b < 6; ++b) total[k++] += wj * j[b];
        total[ALIGNMENT_B + a] += wj * r;
    }
}

INLINE Points16 from_centre16(const Points16 v, const float4 centre) {
    Points16 p;
    p.x = v.x - centre.x;
    p.y = v.y - centre.y;
    p.z = v.z - centre.z;
    return p;
}

/* Of eight pixels, 24 bytes. */
INLINE float8 brightness_of8(const uchar16 a, const uchar8 b) {
    const uchar8 red = (uchar8)(a.s0, a.s3, a.s6, a.s9, a.sc, a.sf, b.s2, b.s5);
    const uchar8 green = (uchar8)(a.s1, a.s4, a.s7, a.sa, a.sd, b.s0, b.s3, b.s6);
    const uchar8 blue = (uchar8)(a.s2, a.s5, a.s8, a.sb, a.se, b.s1, b.s4, b.s7);
    return (0.299f * convert_float8(red) + 0.587f * convert_float8(green) + 0.114f * convert_float8(blue)) * (1.0f / 255.0f);
}

/* Brightness 0..1 of 8-bit red, green, blue (Rec. 601), row-major without padding; 0 beyond the picture. Eight pixels a work-item. */
__kernel void brightness(__global const uchar* rgb, __global float* intensity, const MapShape shape) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1);
    const int pixels = y < shape.height_px ? clamp(shape.width_px - x, 0, 8) : 0;
    __global const uchar* p = rgb + 3 * (y * shape.width_px + x);
    float8 value = (float8)(0.0f);
    if (pixels == 8) {
        value = brightness_of8(vload16(0, p), vload8(0, p + 16));
    } else if (pixels > 0) {
        uchar bytes[24] = {0};
        for (int i = 0; i < 3 * pixels; ++i) bytes[i] = p[i];
        value = brightness_of8(vload16(0, bytes), vload8(0, bytes + 16));
    }
    vstore8(value, 0, intensity + y * shape.pitch_px + x);
}

/* Mean of 2x2 pixels. Eight pixels a work-item. */
__kernel void half_intensity(__global const float* source, __global float* half_map, const MapShape source_shape,
                             const MapShape half_shape) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1);
    float8 result = (float8)(0.0f);
    if (2 * x < source_shape.pitch_px && 2 * y + 1 < source_shape.rows_px) {
        __global const float* top = source + 2 * y * source_shape.pitch_px + 2 * x;
        const float16 a = vload16(0, top), b = vload16(0, top + source_shape.pitch_px);
        result = 0.25f * (a.even + a.odd + b.even + b.odd);
    }
    vstore8(result, 0, half_map + y * half_shape.pitch_px + x);
}

INLINE float16 count16(const int16 mask) { return select((float16)(0.0f), (float16)(1.0f), mask); }

/* A level of a picture: scale is 1 at the finest, a half at the next. */
typedef struct Brightness {
    __global const float* live;
    __global const float* model;
    float scale;
} Brightness;

/* Adds the rows of points v, at (u, v_px) of the model's finest picture: what the live pixels show against what the
 * prediction's camera saw of those points when it was there. */
INLINE void add_brightness16(float16* total, const Brightness brightness, const int at, const MapShape shape, const Intrinsics k,
                             const AlignmentParams params, const Points16 v, const float16 inverse_z, const float16 u,
                             const float16 v_px, const int16 near) {
    const float scale = brightness.scale;
    const float16 column = (u + 0.5f) * scale - 0.5f, row = (v_px + 0.5f) * scale - 0.5f;
    const int16 pair = near & (column >= 0.0f) & (row >= 0.0f) & (column < (float)(shape.width_px - 1)) &
                       (row < (float)(shape.height_px - 1));
    if (!any(pair)) return;
    const float16 x = select((float16)(0.0f), column, pair), y = select((float16)(0.0f), row, pair);
    const float16 left = floor(x), top = floor(y), ax = x - left, ay = y - top;
    const int16 corner = convert_int16_rtz(top) * shape.pitch_px + convert_int16_rtz(left);
    const int16 one = select((int16)(0), (int16)(1), pair), below = corner + shape.pitch_px * one;
    const float16 i00 = gather16(brightness.model, corner), i10 = gather16(brightness.model, corner + one);
    const float16 i01 = gather16(brightness.model, below), i11 = gather16(brightness.model, below + one);
    const float16 r = mix(mix(i00, i10, ax), mix(i01, i11, ax), ay) - vload16(0, brightness.live + at);
    const float16 du = mix(i10 - i00, i11 - i01, ay) * (scale * k.fx_px) * inverse_z;
    const float16 dv = mix(i01 - i00, i11 - i10, ax) * (scale * k.fy_px) * inverse_z;
    Points16 d;
    d.x = -du;
    d.y = -dv;
    d.z = (du * v.x + dv * v.y) * inverse_z;
    const float least_weight = params.reference_sigma_m / params.intensity_sigma;
    const float16 huber = fmin(1.0f, (params.huber_sigmas * params.intensity_sigma) / fmax(fabs(r), 1e-6f));
    const float16 w = select((float16)(0.0f), least_weight * least_weight * huber, pair);
    add_rows16(total, from_centre16(v, params.centre_p), d, r, w);
}

/* One row of pixels a work-item, columns first_x to end_x (multiples of 16) of it: row row_step times the global id; at the
 * global id of sums. Live: depths and normals in the camera frame c. With brightness, rows of both join in A and b; the
 * statistics are of the depths alone. */
__kernel void sum_alignment(__global const float* live_m, __global const float* live_normals_c, __global const float* model_m,
                            __global const float* model_normals_p, __global const float* live_intensity,
                            __global const float* model_intensity, __global float* sums, const MapShape live_shape,
                            const Intrinsics live_k, const MapShape model_shape, const Intrinsics model_k, const Pose T_p_c,
                            const AlignmentParams params, const int level, const int with_brightness, const int row_step,
                            const int first_x, const int end_x) {
    const int y = (int)get_global_id(0) * row_step;
    const int live_plane = live_shape.pitch_px * live_shape.rows_px, model_plane = model_shape.pitch_px * model_shape.rows_px;
    const Brightness brightness = {live_intensity, model_intensity, 1.0f / (float)(1 << level)};
    const float inverse_fx = 1.0f / model_k.fx_px, inverse_fy = 1.0f / model_k.fy_px, inverse_cutoff = 1.0f / params.cutoff_sigmas;
    float16 total[ALIGNMENT_SUMS];
#pragma unroll
    for (int i = 0; i < ALIGNMENT_SUMS; ++i) total[i] = (float16)(0.0f);
    for (int x = first_x; x < end_x; x += 16) {
        const int at = y * live_shape.pitch_px + x;
        const float16 live = vload16(0, live_m + at);
        const int16 measured = live > 0.0f;
        if (!any(measured)) continue;
        total[ALIGNMENT_STATISTICS + 4] += count16(measured);
        const Points16 v = transform_points16(T_p_c, back_project16(live_k, x, y, live));
        const Projection16 seen = project16(model_k, model_shape, v);
        const int16 pixel = select((int16)(-1), seen.row * model_shape.pitch_px + seen.column, seen.inside & measured);
        const float16 model = gather16(model_m, pixel);
        const int16 compared = model > 0.0f;
        if (!any(compared)) continue;
        Points16 n;
        n.x = gather16(model_normals_p, pixel);
        n.y = gather16(model_normals_p + model_plane, pixel);
        n.z = gather16(model_normals_p + 2 * model_plane, pixel);
        const Points16 n_live = rotate_vectors16(T_p_c, load_points16(live_normals_c + at, live_plane));
        // The model's vertex: the pixel that was hit, at the model's depth.
        Points16 d;
        d.x = (convert_float16(seen.column) - model_k.cx_px) * inverse_fx * model - v.x;
        d.y = (convert_float16(seen.row) - model_k.cy_px) * inverse_fy * model - v.y;
        d.z = model - v.z;
        const float16 r = dot16(n, d);
        const float16 n_v = dot16(n, v), v_v = select((float16)(1.0f), dot16(v, v), compared);
        const float16 tan2 = v_v / fmax(n_v * n_v, 0.01f * v_v) - 1.0f;
        const float16 sigma = sigma_z16(params.noise, v.z) + (2.0f * params.noise.grazing) * sqrt(seen.inverse_z) * tan2;
        const float16 inverse_sigma = 1.0f / sigma, sigmas = fabs(r) * inverse_sigma;
        const int16 pair = compared & (dot16(d, d) < params.max_distance_m * params.max_distance_m) &
                           (dot16(n, n_live) > params.min_normal_cos) & (sigmas < params.cutoff_sigmas);
        const float16 scale = params.reference_sigma_m * inverse_sigma;
        const float16 relative = sigmas * inverse_cutoff, tukey = 1.0f - relative * relative;
        const float16 huber = fmin(1.0f, params.huber_sigmas / fmax(sigmas, 1e-6f));
        const float16 w = select((float16)(0.0f), scale * scale * huber * tukey * tukey, pair), counts = count16(w > 0.0f);
        total[ALIGNMENT_STATISTICS] += w;
        total[ALIGNMENT_STATISTICS + 1] += w * r * r;
        total[ALIGNMENT_STATISTICS + 2] += counts;
        total[ALIGNMENT_STATISTICS + 3] += count16(compared);
        total[ALIGNMENT_STATISTICS + 5] += counts * r * r;
        total[ALIGNMENT_STATISTICS + 6] += count16(pair & (sigmas < 2.0f));
        add_rows16(total, from_centre16(v, params.centre_p), n, r, w);
        if (with_brightness) {
            const int16 near = compared & (fabs(d.z) < params.max_distance_m);
            add_brightness16(total, brightness, at, live_shape, model_k, params, v, seen.inverse_z, seen.u, seen.v, near);
        }
    }
#pragma unroll
    for (int i = 0; i < ALIGNMENT_SUMS; ++i) sums[(int)get_global_id(0) * ALIGNMENT_SUMS + i] = sum16(total[i]);
}
