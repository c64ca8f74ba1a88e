/* What moves apart from the model: a live point that is not of the model belongs to something that came there by itself where
 * free space was seen: by a coarse grid over the cube in the long run, by the picture of a few frames ago in the short run. A
 * new surface of a still scene comes from where nobody has looked. */

/* Maps of the nearest depth in windows of 1, 2, 4 ... 32 pixels, each window at its top left pixel; 0 where a pixel of a window
 * has no depth or is beyond the map. One map after the other, each with WINDOW_SLACK values to spare. */
#define WINDOW_LEVELS 6
#define WINDOW_SLACK 64

INLINE int window_map(const MapShape shape, const int level) {
    return level * (shape.pitch_px * shape.rows_px + WINDOW_SLACK);
}

/* One of the maps; windows of one pixel are the depths. Eight pixels a work-item. */
__kernel void copy_windows(__global const float* windows_m, __global float* map_m, const MapShape shape, const int level) {
    const int at = (int)get_global_id(1) * shape.pitch_px + (int)get_global_id(0) * 8;
    vstore8(vload8(0, windows_m + window_map(shape, level) + at), 0, map_m + at);
}

/* Windows of 2^level pixels from those of half the size. Eight pixels a work-item. */
__kernel void double_windows(__global float* windows_m, const MapShape shape, const int level) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1), at = y * shape.pitch_px + x, half_px = 1 << (level - 1);
    float8 nearest = (float8)(0.0f);
    if (y + half_px < shape.rows_px) {
        __global const float* top = windows_m + window_map(shape, level - 1) + at;
        __global const float* bottom = top + half_px * shape.pitch_px;
        nearest = fmin(fmin(vload8(0, top), vload8(0, top + half_px)), fmin(vload8(0, bottom), vload8(0, bottom + half_px)));
        nearest = select((float8)(0.0f), nearest, lanes8() + (float)(x + half_px) < (float)shape.pitch_px);
    }
    vstore8(nearest, 0, windows_m + window_map(shape, level) + at);
}

/* Nearest depth in squares of the picture around (u, v); 0 where a square is not all in the picture, too large, or has a pixel
 * without depth. Four windows cover a square. */
INLINE float8 nearest_in_square8(__global const float* windows_m, const MapShape shape, const float8 u, const float8 v,
                                 const float8 reach_px, const int8 judged) {
    const int8 inside = judged & (u - reach_px >= 0.0f) & (v - reach_px >= 0.0f) & (reach_px < 31.0f) &
                        (u + reach_px < (float)shape.width_px) & (v + reach_px < (float)shape.height_px);
    const float8 none = (float8)(0.0f);
    if (!any(inside)) return none;
    const int8 x0 = convert_int8_rtz(select(none, u - reach_px, inside)), x1 = convert_int8_rtz(select(none, u + reach_px, inside));
    const int8 y0 = convert_int8_rtz(select(none, v - reach_px, inside)), y1 = convert_int8_rtz(select(none, v + reach_px, inside));
    const int8 level = 31 - convert_int8(clz(convert_uint8(max(x1 - x0, y1 - y0) + 1)));
    const int8 window = ((int8)(1) << level) - 1;
    const int8 map = level * (shape.pitch_px * shape.rows_px + WINDOW_SLACK);
    const int8 left = x0, right = max(x1 - window, 0);
    const int8 top = map + y0 * shape.pitch_px, bottom = map + max(y1 - window, 0) * shape.pitch_px;
    const int8 no = (int8)(-1);
    const float8 upper = fmin(gather8(windows_m, select(no, top + left, inside)), gather8(windows_m, select(no, top + right, inside)));
    const float8 lower = fmin(gather8(windows_m, select(no, bottom + left, inside)), gather8(windows_m, select(no, bottom + right, inside)));
    return fmin(upper, lower);
}

/* Counts for each cell of the grid (n^3 over the volume's cube) in how many frames, up to most_frames, it was wholly in front of
 * what the camera saw; a cell with a still surface in it loses two. seen_taken counts, up to 255, those in which there was a
 * surface in it (taken_now), and loses half where it was free. Eight cells along x a work-item; global size (n / 8, n, n). */
__kernel void remember_free_space(__global const float* depth_m, __global const uchar* moving, __global const float* windows_m,
                                  __global const uchar* taken_now, __global uchar* seen_free, __global uchar* seen_taken,
                                  const float cell_m, const int n, const int most_frames,
                                  const SensorNoise noise, const Intrinsics k, const MapShape shape, const Pose T_c_g) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1), z = (int)get_global_id(2);
    Points8 centre;
    centre.x = (lanes8() + ((float)x + 0.5f)) * cell_m;
    centre.y = (float8)(((float)y + 0.5f) * cell_m);
    centre.z = (float8)(((float)z + 0.5f) * cell_m);
    const Points8 p = transform_points8(T_c_g, centre);
    const int8 pixel = project_to_index8(k, shape, p);
    if (!any(pixel >= 0)) return;
    const float half_m = 0.87f * cell_m;  // of the diagonal
    const int8 judged = (pixel >= 0) & (p.z > half_m + 0.05f);
    const float8 inverse_z = 1.0f / select((float8)(1.0f), p.z, judged);
    const float8 a = p.x * inverse_z, b = p.y * inverse_z;
    // A ball off the axis projects to an ellipse that is longer by the length of its ray at z = 1.
    const float8 reach_px = k.fx_px * half_m * (1.0f + 0.5f * (a * a + b * b)) / select((float8)(1.0f), p.z - half_m, judged);
    const float8 nearest = nearest_in_square8(windows_m, shape, a * k.fx_px + k.cx_px, b * k.fy_px + k.cy_px, reach_px, judged);
    const float8 far_m = p.z + half_m;
    const int8 free = nearest > far_m + 3.0f * sigma_z8(noise, far_m);
    const float8 seen = gather8(depth_m, pixel);
    const int8 still = (pixel >= 0) & (convert_int8(gather_uchar8(moving, pixel)) == 0) & (seen > 0.0f);
    const int8 taken = still & (fabs(seen - p.z) < half_m + sigma_z8(noise, p.z));
    __global uchar* counts = seen_free + (z * n + y) * n + x;
    const int8 old = convert_int8(vload8(0, counts));
    const int8 less = select(old, max(old - 2, 0), taken);
    vstore8(convert_uchar8(select(less, min(old + 1, most_frames), free)), 0, counts);
    const int cell = (z * n + y) * n + x;
    const int8 age = convert_int8(vload8(0, seen_taken + cell));
    const int8 older = select(age, min(age + 1, 255), (pixel >= 0) & (convert_int8(vload8(0, taken_now + cell)) != 0));
    vstore8(convert_uchar8(select(older, age / 2, free)), 0, seen_taken + cell);
}

/* Of points in the global frame; -1 outside the cube. */
INLINE int8 cell_index8(const float cell_m, const int n, const Points8 p_g) {
    const float8 x = p_g.x / cell_m, y = p_g.y / cell_m, z = p_g.z / cell_m;
    const float side = (float)n;
    const int8 inside = (x >= 0.0f) & (y >= 0.0f) & (z >= 0.0f) & (x < side) & (y < side) & (z < side);
    const float8 none = (float8)(0.0f);
    const int8 i = convert_int8_rtz(select(none, x, inside)), j = convert_int8_rtz(select(none, y, inside));
    const int8 l = convert_int8_rtz(select(none, z, inside));
    return select((int8)(-1), (l * n + j) * n + i, inside);
}

/* 1 for each cell of the grid in which the camera sees a surface; others are left. Eight pixels a work-item. */
__kernel void mark_taken(__global const float* depth_m, __global uchar* taken_now, const MapShape shape, const Intrinsics k,
                         const Pose T_g_c, const float cell_m, const int n) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1);
    const float8 depth = vload8(0, depth_m + y * shape.pitch_px + x);
    const Points8 p_g = transform_points8(T_g_c, back_project8(k, x, y, depth));
    const int8 cells = select((int8)(-1), cell_index8(cell_m, n, p_g), depth > 0.0f);
    int index[8];
    vstore8(cells, 0, index);
    for (int i = 0; i < 8; ++i)
        if (index[i] >= 0) taken_now[index[i]] = 1;
}

INLINE int8 in_free_space8(__global const uchar* seen_free, const float cell_m, const int n, const int enough_frames,
                           const Points8 p_g) {
    const int8 cell = cell_index8(cell_m, n, p_g);
    return (cell >= 0) & (convert_int8(gather_uchar8(seen_free, cell)) >= enough_frames);
}

/* One ComponentMember per pixel, of points in the cube that are not of the model. MEMBER_SEED: a few frames ago the camera, in
 * whose frame b T_b_c takes the point, saw through it and eight pixels around (before_m: windows of eight pixels);
 * MEMBER_UNKNOWN: it lies in free space, by a cell or four sigma at least; the others can be grown into, where there is no
 * model only if into_unknown. young: 255 where there was a surface in less than young_frames frames (0: nowhere), which can be
 * grown into, too, also where it is of the model by now. Eight pixels a work-item. */
__kernel void mark_moving(__global const uchar* codes, __global const float* live_m, __global const uchar* seen_free,
                          __global const uchar* seen_taken, __global const float* before_m, __global uchar* members,
                          __global uchar* young, const MapShape shape, const Intrinsics k, const Pose T_g_c, const Pose T_b_c,
                          const float cell_m, const int n, const int enough_frames, const int young_frames, const int into_unknown,
                          const SensorNoise noise) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1), at = y * shape.pitch_px + x;
    const int8 code = convert_int8(vload8(0, codes + at));
    const int8 in_front = (code == ASSOCIATION_IN_FRONT) | (code == ASSOCIATION_SLIGHTLY_IN_FRONT);
    const int8 no_model = code == ASSOCIATION_NO_MODEL, behind = code == ASSOCIATION_BEHIND;
    const int8 apart = in_front | no_model | behind;
    int8 member = (int8)(MEMBER_NONE), is_young = (int8)(0);
    if (any(apart) || young_frames > 0) {
        const float8 live = vload8(0, live_m + at), margin_m = 4.0f * sigma_z8(noise, live);
        const Points8 p = back_project8(k, x, y, live), p_g = transform_points8(T_g_c, p);
        const int8 cell = cell_index8(cell_m, n, p_g);
        const int8 in_cube = (live > 0.0f) & (cell >= 0), inside = apart & in_cube;
        is_young = in_cube & (convert_int8(gather_uchar8(seen_taken, cell)) < young_frames);
        const Points8 deeper = back_project8(k, x, y, live + fmax((float8)(cell_m), margin_m));
        const int8 free = in_free_space8(seen_free, cell_m, n, enough_frames, p_g) &
                          in_free_space8(seen_free, cell_m, n, enough_frames, transform_points8(T_g_c, deeper));
        const Points8 p_b = transform_points8(T_b_c, p);
        const int8 middle = project_to_index8(k, shape, p_b), corner = middle - (4 * shape.pitch_px + 4);
        const float8 before = gather8(before_m, select((int8)(-1), corner, middle >= 0));
        const int8 came = before > p_b.z + margin_m;
        const int8 growth = (inside & (in_front | (into_unknown ? no_model : (int8)(0)))) | (is_young & ~behind);
        member = select(member, (int8)(MEMBER_GROWTH), growth);
        member = select(member, (int8)(MEMBER_UNKNOWN), inside & free);
        member = select(member, (int8)(MEMBER_SEED), inside & came);
    }
    vstore8(convert_uchar8(member), 0, members + at);
    vstore8(convert_uchar8(is_young), 0, young + at);
}

/* Frames that a pixel is still held to be of a moving part. hold_frames where its component moves as a whole (label 0), or
 * (label 1) where it is of one and before the model or in free space; elsewhere one less than what the pixel of the last frame
 * was, that it or a neighbour of it shows again, while there is no model there or a young one. mask is 255 where it is not 0.
 * Eight pixels a work-item; last: of the camera p. */
__kernel void hold_moving(__global const int* labels, __global const uchar* members, __global const uchar* codes,
                          __global const float* live_m, __global const float* last_m, __global const uchar* last_held,
                          __global uchar* held, __global uchar* mask, const MapShape shape, const Intrinsics k, const Pose T_p_c,
                          const int hold_frames, const SensorNoise noise) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1), at = y * shape.pitch_px + x;
    const int8 code = convert_int8(vload8(0, codes + at)), label = vload8(0, labels + at);
    const int8 no_model = code == ASSOCIATION_NO_MODEL;
    const int8 member = convert_int8(vload8(0, members + at));
    const int8 in_front = (code == ASSOCIATION_IN_FRONT) | (code == ASSOCIATION_SLIGHTLY_IN_FRONT);
    const int8 known = in_front | (member > MEMBER_GROWTH);
    const int8 apart = no_model | in_front | (member == MEMBER_GROWTH);
    int8 left = (int8)(0);
    if (any(apart)) {
        const float8 live = vload8(0, live_m + at);
        const Points8 p = transform_points8(T_p_c, back_project8(k, x, y, live));
        const int8 pixel = project_to_index8(k, shape, p), within = apart & (live > 0.0f) & (pixel >= 0);
        const float8 gap_m = fmax(4.0f * sigma_z8(noise, live), 0.004f);
        const int steps[5] = {0, -1, 1, -shape.pitch_px, shape.pitch_px}, end = shape.pitch_px * shape.rows_px;
        for (int i = 0; i < 5; ++i) {
            const int8 last = pixel + steps[i], there = within & (last >= 0) & (last < end);
            const int8 index = select((int8)(-1), last, there);
            const int8 same = there & (fabs(gather8(last_m, index) - p.z) < gap_m);
            left = max(left, select((int8)(0), convert_int8(gather_uchar8(last_held, index)) - 1, same));
        }
    }
    left = select(left, (int8)(hold_frames), (label == 0) | ((label == 1) & known));
    vstore8(convert_uchar8(left), 0, held + at);
    vstore8(convert_uchar8(left > 0), 0, mask + at);
}

/* 255 within radius_px rows of `wide`. Eight pixels a work-item. */
__kernel void widen_columns(__global const uchar* wide, __global uchar* mask, const MapShape shape, const int radius_px) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1);
    uchar8 result = (uchar8)(0);
    for (int j = max(y - radius_px, 0); j <= min(y + radius_px, shape.rows_px - 1); ++j)
        result |= vload8(0, wide + j * shape.pitch_px + x);
    vstore8(result, 0, mask + y * shape.pitch_px + x);
}
