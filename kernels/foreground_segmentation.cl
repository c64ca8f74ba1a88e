/* Fig 14 b to d, around the connected components: candidates from the outlier map, the wider mask that the background's
 * integration leaves out, and what was last seen where the volume has no surface. */

/* k standard deviations of depth around each depth of a surface that faces the camera. */
INLINE float8 depth_tolerance8(const CandidateParams params, const float8 z) {
    const float8 sigma = sigma_z8(params.noise, z), step = params.quantisation_per_m * z * z;
    return params.sigmas_high * sqrt(sigma * sigma + step * step);
}

INLINE float8 load_or_zero8(__global const float* row, const int x, const MapShape shape) {
    return x >= 0 && x < shape.pitch_px ? vload8(0, row + x) : (float8)(0.0f);
}

INLINE float8 nearer8(const float8 nearest, const float8 z) { return select(nearest, fmin(nearest, z), z > 0.0f); }

/* Nearest surface of the model within two pixels; FLT_MAX where there is none. */
INLINE float8 nearest_around8(__global const float* model_m, const int x, const int y, const MapShape shape) {
    float8 nearest = (float8)(FLT_MAX);
    for (int j = max(y - 2, 0); j <= min(y + 2, shape.rows_px - 1); ++j) {
        __global const float* row = model_m + j * shape.pitch_px;
        const float8 a = load_or_zero8(row, x - 8, shape), b = vload8(0, row + x), c = load_or_zero8(row, x + 8, shape);
        nearest = nearer8(nearest, (float8)(a.s67, b.s0123, b.s45));
        nearest = nearer8(nearest, (float8)(a.s7, b.s0123, b.s456));
        nearest = nearer8(nearest, b);
        nearest = nearer8(nearest, (float8)(b.s1234, b.s567, c.s0));
        nearest = nearer8(nearest, (float8)(b.s2345, b.s67, c.s01));
    }
    return nearest;
}

/* One ComponentMember per pixel. A pixel surely in front is a seed, unless the model has an edge beside it and its
 * nearer side explains the depth: edges of still things flicker by a pixel or two. Where there is no model, a pixel
 * nearer than all model beside it is a seed; far from any model it is MEMBER_UNKNOWN. The others can only be grown
 * into. */
__kernel void mark_candidates(__global const uchar* codes, __global const float* live_m, __global const float* model_m,
                              __global const float* fallback_m, __global uchar* members, const MapShape shape,
                              const CandidateParams params) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1), at = y * shape.pitch_px + x;
    const uchar8 packed = vload8(0, codes + at);
    if (as_ulong(packed > (uchar8)(ASSOCIATION_NO_LIVE_DEPTH)) == 0) {
        vstore8((uchar8)(MEMBER_NONE), 0, members + at);
        return;
    }
    const int8 code = convert_int8(packed);
    const int8 in_front = code == ASSOCIATION_IN_FRONT, no_model = code == ASSOCIATION_NO_MODEL;
    int8 member = select((int8)(MEMBER_NONE), (int8)(MEMBER_GROWTH), code == ASSOCIATION_SLIGHTLY_IN_FRONT);
    if (any(in_front | no_model)) {
        const float8 live = vload8(0, live_m + at), predicted = vload8(0, model_m + at);
        const float8 model = select(vload8(0, fallback_m + at), predicted, predicted > 0.0f);
        const float8 tolerance = depth_tolerance8(params, live);
        const float8 nearest = nearest_around8(model_m, x, y, shape);
        const int8 none_around = nearest == FLT_MAX;
        const int8 before_all = live < nearest - tolerance;
        const int8 edge = nearest < model - (params.jump_per_m * live + tolerance);
        const int8 unknown = no_model & none_around & (live < params.unknown_depth_m - tolerance);
        const int8 seed = (in_front & (~edge | before_all)) | (no_model & ~none_around & before_all);
        member = select(member, (int8)(MEMBER_GROWTH), in_front | no_model);
        member = select(member, (int8)(MEMBER_UNKNOWN), unknown);
        member = select(member, (int8)(MEMBER_SEED), seed);
    }
    vstore8(convert_uchar8(member), 0, members + at);
}

INLINE uchar8 load_bytes_or_zero8(__global const uchar* row, const int x, const MapShape shape) {
    return x >= 0 && x < shape.pitch_px ? vload8(0, row + x) : (uchar8)(0);
}

/* Members with MEMBER_EXPECTED where `held` is at least least_held. */
INLINE uchar8 with_expected8(const uchar8 member, const uchar8 held, const uchar least_held) {
    const char8 expected = (member != (uchar8)(0)) & (held >= (uchar8)(least_held));
    return select(member, member | (uchar8)(MEMBER_EXPECTED), expected);
}

/* A seed stays one when at least 7 of the 9 pixels around it (with it) are members; else it can only be grown into. So
 * strips of one or two pixels hold no seed. The same for MEMBER_UNKNOWN. `held`: of mask_background; at least least_held where
 * the foreground was a moment ago. */
__kernel void keep_supported_seeds(__global const uchar* members, __global const uchar* held, __global uchar* supported,
                                   const MapShape shape, const int least_held) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1), at = y * shape.pitch_px + x;
    const uchar8 member = vload8(0, members + at), before = vload8(0, held + at);
    if (as_ulong(member > (uchar8)(MEMBER_GROWTH)) == 0) {
        vstore8(with_expected8(member, before, (uchar)least_held), 0, supported + at);
        return;
    }
    uchar8 around = (uchar8)(0);
    for (int j = max(y - 1, 0); j <= min(y + 1, shape.rows_px - 1); ++j) {
        __global const uchar* row = members + j * shape.pitch_px;
        const uchar8 a = load_bytes_or_zero8(row, x - 8, shape), b = vload8(0, row + x);
        const uchar8 c = load_bytes_or_zero8(row, x + 8, shape);
        around += min((uchar8)(a.s7, b.s0123, b.s456), (uchar8)(1)) + min(b, (uchar8)(1)) +
                  min((uchar8)(b.s1234, b.s567, c.s0), (uchar8)(1));
    }
    const char8 weak = (member > (uchar8)(MEMBER_GROWTH)) & (around < (uchar8)(7));
    vstore8(with_expected8(select(member, (uchar8)(MEMBER_GROWTH), weak), before, (uchar)least_held), 0, supported + at);
}

/* 255 where either mask is not 0. Eight pixels a work-item; global size (pitch / 8, rows). */
__kernel void join_masks(__global const uchar* a, __global const uchar* b, __global uchar* joined, const MapShape shape) {
    const int at = (int)get_global_id(1) * shape.pitch_px + (int)get_global_id(0) * 8;
    const uchar8 either = vload8(0, a + at) | vload8(0, b + at);
    vstore8(convert_uchar8(either != (uchar8)(0)), 0, joined + at);
}

/* 255 within radius_px (at most 8) columns of the mask. */
__kernel void widen_rows(__global const uchar* mask, __global uchar* wide, const MapShape shape, const int radius_px) {
    const int x = (int)get_global_id(0) * 8, at = (int)get_global_id(1) * shape.pitch_px;
    uchar lanes[24];
    const uchar8 a = load_bytes_or_zero8(mask + at, x - 8, shape), b = vload8(0, mask + at + x);
    const uchar8 c = load_bytes_or_zero8(mask + at, x + 8, shape);
    uchar8 result = (uchar8)(0);
    if (as_ulong(a | b | c) != 0) {
        vstore8(a, 0, lanes);
        vstore8(b, 1, lanes);
        vstore8(c, 2, lanes);
        for (int i = -radius_px; i <= radius_px; ++i) result |= vload8(0, lanes + 8 + i);
    }
    vstore8(result, 0, wide + at + x);
}

INLINE uchar8 rows_since8(const uchar8 distance, const uchar8 mask) {
    return select(add_sat(distance, (uchar8)(1)), (uchar8)(0), mask != (uchar8)(0));
}

/* Where a pixel is not masked and the model has no surface, fallback_m follows the live depth. */
INLINE void learn_fallback8(__global const float* live_m, __global const float* model_m, __global float* fallback_m,
                            const char8 masked) {
    const int8 wanted = (vload8(0, model_m) <= 0.0f) & ~convert_int8(masked);
    if (!any(wanted)) return;
    const float8 live = vload8(0, live_m), old = vload8(0, fallback_m);
    const float8 average = select(live, old + (live - old) * 0.0625f, old > 0.0f);
    vstore8(select(old, average, wanted & (live > 0.0f)), 0, fallback_m);
}

/* The mask of the background's integration: within radius_px rows of `wide`, now or at most hold_frames ago; counts the
 * frames that are left in `held`. Half a tile a work-item: global size (pitch / 8, rows / 16). */
__kernel void mask_background(__global const uchar* wide, __global const float* live_m, __global const float* model_m,
                              __global uchar* held, __global uchar* mask, __global float* fallback_m,
                              const MapShape shape, const int radius_px, const int hold_frames) {
    const int x = (int)get_global_id(0) * 8, first = (int)get_global_id(1) * TILE_PX, pitch = shape.pitch_px;
    const int from = max(first - radius_px, 0), end = min(first + TILE_PX + radius_px, shape.rows_px);
    uchar8 busy = (uchar8)(0);
    for (int y = from; y < end; ++y) busy |= vload8(0, wide + y * pitch + x);
    for (int y = first; y < first + TILE_PX; ++y) busy |= vload8(0, held + y * pitch + x);
    if (as_ulong(busy) == 0) {
        for (int at = first * pitch + x; at < (first + TILE_PX) * pitch; at += pitch) {
            vstore8((uchar8)(0), 0, mask + at);
            learn_fallback8(live_m + at, model_m + at, fallback_m + at, (char8)(0));
        }
        return;
    }
    char8 near[TILE_PX];
    uchar8 distance = (uchar8)(255);
    for (int y = from; y < first + TILE_PX; ++y) {
        distance = rows_since8(distance, vload8(0, wide + y * pitch + x));
        if (y >= first) near[y - first] = distance <= (uchar8)(radius_px);
    }
    distance = (uchar8)(255);
    for (int y = end - 1; y >= first; --y) {
        distance = rows_since8(distance, vload8(0, wide + y * pitch + x));
        if (y < first + TILE_PX) near[y - first] |= distance <= (uchar8)(radius_px);
    }
    for (int i = 0; i < TILE_PX; ++i) {
        const int at = (first + i) * pitch + x;
        const uchar8 left = select(sub_sat(vload8(0, held + at), (uchar8)(1)), (uchar8)(hold_frames + 1), near[i]);
        const char8 masked = left != (uchar8)(0);
        vstore8(left, 0, held + at);
        vstore8(convert_uchar8(masked), 0, mask + at);
        learn_fallback8(live_m + at, model_m + at, fallback_m + at, masked);
    }
}
