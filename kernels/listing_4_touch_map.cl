/* Listing 4: touch map. The background's ray was cast by Listing 3 and is cached as the surface prediction; overlap is
 * tested on the signed distance to the background along its normal instead of the distance along the ray. */

#define HOLE_PX 8

typedef struct Surface8 {
    Points8 v, n;
    int8 known;
} Surface8;

/* The background at eight map indices; unknown where the index is negative or nothing was predicted. */
INLINE Surface8 gather_surface8(__global const float* depth_m, __global const float* normals_c, const Intrinsics k,
                                const MapShape shape, const int8 pixel) {
    const int plane = shape.pitch_px * shape.rows_px;
    const int8 row = max(pixel, 0) / shape.pitch_px, column = max(pixel, 0) - row * shape.pitch_px;
    Surface8 s;
    s.v.z = gather8(depth_m, pixel);
    s.v.x = (convert_float8(column) - k.cx_px) / k.fx_px * s.v.z;
    s.v.y = (convert_float8(row) - k.cy_px) / k.fy_px * s.v.z;
    s.n.x = gather8(normals_c, pixel);
    s.n.y = gather8(normals_c + plane, pixel);
    s.n.z = gather8(normals_c + 2 * plane, pixel);
    s.known = (s.v.z > 0.0f) & (dot8(s.n, s.n) > 0.5f);
    return s;
}

/* The same at the eight pixels that start at (x, y). */
INLINE Surface8 load_surface8(__global const float* depth_m, __global const float* normals_c, const Intrinsics k,
                              const MapShape shape, const int x, const int y) {
    const int plane = shape.pitch_px * shape.rows_px, at = y * shape.pitch_px + x;
    Surface8 s;
    s.v = back_project8(k, x, y, vload8(0, depth_m + at));
    s.n.x = vload8(0, normals_c + at);
    s.n.y = vload8(0, normals_c + plane + at);
    s.n.z = vload8(0, normals_c + 2 * plane + at);
    s.known = (s.v.z > 0.0f) & (dot8(s.n, s.n) > 0.5f);
    return s;
}

/* Where a lane of s is unknown, the first known surface among four pixels around: holes of the prediction are narrow and
 * lie along edges. */
INLINE Surface8 fill_from_around8(const Surface8 s, __global const float* depth_m, __global const float* normals_c,
                                  const Intrinsics k, const MapShape shape, const int8 pixel, const int8 wanted) {
    const int2 offsets[4] = {(int2)(HOLE_PX, 0), (int2)(-HOLE_PX, 0), (int2)(0, HOLE_PX), (int2)(0, -HOLE_PX)};
    Surface8 filled = s;
    for (int i = 0; i < 4 && any(wanted & ~filled.known); ++i) {
        const int8 row = pixel / shape.pitch_px + offsets[i].y, column = pixel % shape.pitch_px + offsets[i].x;
        const int8 inside = (column >= 0) & (row >= 0) & (column < shape.width_px) & (row < shape.height_px);
        const int8 near = select((int8)(-1), row * shape.pitch_px + column, inside & wanted & ~filled.known);
        const Surface8 other = gather_surface8(depth_m, normals_c, k, shape, near);
        filled.v.x = select(filled.v.x, other.v.x, other.known), filled.n.x = select(filled.n.x, other.n.x, other.known);
        filled.v.y = select(filled.v.y, other.v.y, other.known), filled.n.y = select(filled.n.y, other.n.y, other.known);
        filled.v.z = select(filled.v.z, other.v.z, other.known), filled.n.z = select(filled.n.z, other.n.z, other.known);
        filled.known |= other.known;
    }
    return filled;
}

INLINE float8 height_over8(const Surface8 s, const Points8 v) {
    return (v.x - s.v.x) * s.n.x + ((v.y - s.v.y) * s.n.y + (v.z - s.v.z) * s.n.z);
}

/* The pixel of the foot point of v on the tangent plane of s. */
INLINE int8 foot_pixel8(const Surface8 s, const Points8 v, const float8 height_m, const Intrinsics k,
                        const MapShape shape) {
    Points8 foot;
    foot.x = v.x - height_m * s.n.x;
    foot.y = v.y - height_m * s.n.y;
    foot.z = v.z - height_m * s.n.z;
    return project_to_index8(k, shape, foot);
}

/* Whether any of the eight pixels or of the pixels beside them is in the mask. */
INLINE int near_mask8(__global const uchar* mask, const MapShape shape, const int x, const int y) {
    uchar8 found = (uchar8)(0);
    for (int j = max(y - 1, 0); j <= min(y + 1, shape.rows_px - 1); ++j) {
        __global const uchar* row = mask + j * shape.pitch_px;
        found |= vload8(0, row + x) | (uchar8)(row[max(x - 1, 0)] | row[min(x + 8, shape.pitch_px - 1)]);
    }
    return as_ulong(found) != 0;
}

/* Eight pixels a work-item; global size (width / 8, height) of a rectangle of the map that starts at (origin_x, origin_y),
 * origin_x a multiple of 8. height_m is UNKNOWN_HEIGHT_M where the live depth or the background around is missing, and far from
 * the mask. */
__kernel void touch_map(__global const float* live_m, __global const uchar* mask, __global const float* background_m,
                        __global const float* normals_c, __global float* height_m, __global uchar* touch, const int origin_x,
                        const int origin_y, const Intrinsics k, const MapShape shape, const TouchMapParams params) {
    const int x = origin_x + (int)get_global_id(0) * 8, y = origin_y + (int)get_global_id(1);
    const int at = y * shape.pitch_px + x;  // L4:2
    if (!near_mask8(mask, shape, x, y)) {
        vstore8((uchar8)(0), 0, touch + at);
        vstore8((float8)(UNKNOWN_HEIGHT_M), 0, height_m + at);
        return;
    }
    const float8 z = vload8(0, live_m + at);
    const Points8 v_fg = back_project8(k, x, y, z);  // L4:1
    const int8 here = convert_int8_rte(lanes8()) + at;
    const Surface8 hit = load_surface8(background_m, normals_c, k, shape, x, y);  // L4:3
    Surface8 bg = fill_from_around8(hit, background_m, normals_c, k, shape, here, z > 0.0f);
    const int8 used = (z > 0.0f) & bg.known;                                 // L4:4
    float8 height = height_over8(bg, v_fg);
    for (int i = 0; i < 2 && any(used); ++i) {
        const int8 pixel = select((int8)(-1), foot_pixel8(bg, v_fg, height, k, shape), used);
        const Surface8 foot = gather_surface8(background_m, normals_c, k, shape, pixel);  // L4:5
        const float8 foot_height = height_over8(foot, v_fg);
        // What the camera sees in front of the background is not below it: that plane belongs to something else.
        const int8 better = foot.known & ((foot_height > 0.0f) | (height < 0.0f));
        height = select(height, foot_height, better);
        bg.v.x = select(bg.v.x, foot.v.x, better), bg.n.x = select(bg.n.x, foot.n.x, better);
        bg.v.y = select(bg.v.y, foot.v.y, better), bg.n.y = select(bg.n.y, foot.n.y, better);
        bg.v.z = select(bg.v.z, foot.v.z, better), bg.n.z = select(bg.n.z, foot.n.z, better);
    }
    const float8 sigma_m = sigma_z8(params.noise, z);
    const float8 threshold_m = params.finger_thickness_m + params.threshold_sigmas * sigma_m;
    const int8 overlap = (height < threshold_m) & (height > -params.threshold_sigmas * sigma_m);  // L4:6
    const int8 touched = used & overlap & (convert_int8(vload8(0, mask + at)) != 0);
    vstore8(convert_uchar8(touched & 255), 0, touch + at);  // L4:7
    vstore8(select((float8)(UNKNOWN_HEIGHT_M), height, used), 0, height_m + at);
}
