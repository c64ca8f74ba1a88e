/* Which bricks a depth picture touches, and which part of the picture a brick covers: no rays, no holes. */

/* The depths that are integrated: 0 where the sample's weight is 0. */
INLINE float8 load_weighted8(__global const float* depth_m, __global const uchar* sample_weights, const int at) {
    return select((float8)(0.0f), vload8(0, depth_m + at), convert_int8(vload8(0, sample_weights + at)) != 0);
}

/* Nearest and farthest depth of each 16x16 tile (0, 0 where there is none). One tile a work-item. */
__kernel void depth_tile_ranges(__global const float* depth_m, __global const uchar* sample_weights, __global float2* ranges_m,
                                const MapShape shape) {
    const int tile_x = (int)get_global_id(0), tile_y = (int)get_global_id(1);
    float8 nearest = (float8)(FLT_MAX), farthest = (float8)(0.0f);
    for (int j = 0; j < TILE_PX; ++j) {
        const int row = (tile_y * TILE_PX + j) * shape.pitch_px + tile_x * TILE_PX;
        for (int i = 0; i < TILE_PX; i += 8) {
            const float8 z = load_weighted8(depth_m, sample_weights, row + i);
            nearest = fmin(nearest, select((float8)(FLT_MAX), z, z > 0.0f));
            farthest = fmax(farthest, z);
        }
    }
    const float4 n4 = fmin(nearest.lo, nearest.hi), f4 = fmax(farthest.lo, farthest.hi);
    const float2 n2 = fmin(n4.lo, n4.hi), f2 = fmax(f4.lo, f4.hi);
    const float far_m = fmax(f2.x, f2.y);
    const float near_m = far_m > 0.0f ? fmin(n2.x, n2.y) : 0.0f;
    ranges_m[tile_y * (shape.pitch_px / TILE_PX) + tile_x] = (float2)(near_m, far_m);
}

/* What eight bricks cover of the picture. */
typedef struct BrickViews8 {
    int8 first_x, last_x, first_y, last_y; /* pixels; last_x < first_x where a brick is not in view */
    float8 near_m, far_m;
} BrickViews8;

/* Depth range and pixels of the boxes around bricks, parallel to the camera's axes and grown by margin_m. Bricks that reach the
 * camera are left out. */
INLINE BrickViews8 view_bricks8(const int8 x, const int8 y, const int8 z, const VolumeParams volume, const Intrinsics k,
                                const MapShape shape, const Pose T_c_g, const float margin_m) {
    const float side_m = volume.voxel_m * BRICK_VOX, half_m = 0.5f * side_m + margin_m;
    Points8 center;
    center.x = (convert_float8(x) + 0.5f) * side_m;
    center.y = (convert_float8(y) + 0.5f) * side_m;
    center.z = (convert_float8(z) + 0.5f) * side_m;
    center = transform_points8(T_c_g, center);
    const float across_m = half_m * (fabs(T_c_g.row_x.x) + fabs(T_c_g.row_x.y) + fabs(T_c_g.row_x.z));
    const float down_m = half_m * (fabs(T_c_g.row_y.x) + fabs(T_c_g.row_y.y) + fabs(T_c_g.row_y.z));
    const float deep_m = half_m * (fabs(T_c_g.row_z.x) + fabs(T_c_g.row_z.y) + fabs(T_c_g.row_z.z));
    BrickViews8 view;
    view.near_m = center.z - deep_m;
    view.far_m = center.z + deep_m;
    const int8 ahead = view.near_m > 0.05f;
    const float8 per_near = 1.0f / select((float8)(1.0f), view.near_m, ahead);
    const float8 per_far = 1.0f / select((float8)(1.0f), view.far_m, ahead);
    const float8 left = k.fx_px * (center.x - across_m), right = k.fx_px * (center.x + across_m);
    const float8 top = k.fy_px * (center.y - down_m), bottom = k.fy_px * (center.y + down_m);
    const float8 low_x = fmin(left * per_near, left * per_far) + (k.cx_px - 0.5f);
    const float8 low_y = fmin(top * per_near, top * per_far) + (k.cy_px - 0.5f);
    const float8 high_x = fmax(right * per_near, right * per_far) + (k.cx_px + 0.5f);
    const float8 high_y = fmax(bottom * per_near, bottom * per_far) + (k.cy_px + 0.5f);
    const float width = (float)shape.width_px, height = (float)shape.height_px;
    const int8 seen = ahead & (low_x < width) & (low_y < height) & (high_x >= 0.0f) & (high_y >= 0.0f);
    const float8 none = (float8)(0.0f);
    view.first_x = convert_int8_rtz(select(none, fmax(low_x, 0.0f), seen));
    view.first_y = convert_int8_rtz(select(none, fmax(low_y, 0.0f), seen));
    view.last_x = select((int8)(-1), convert_int8_rtz(select(none, fmin(high_x, width - 1.0f), seen)), seen);
    view.last_y = select((int8)(-1), convert_int8_rtz(select(none, fmin(high_y, height - 1.0f), seen)), seen);
    return view;
}

/* Of a list of bricks the eight from `first` on; behind its end the last one again. */
INLINE BrickViews8 view_listed8(__global const int* bricks, const int first, const int count, const VolumeParams volume,
                                const Intrinsics k, const MapShape shape, const Pose T_c_g, const float margin_m) {
    const int n = volume.bricks_per_side;
    const int8 brick = gather_int8(bricks, min(convert_int8(lanes8()) + first, count - 1));
    const int8 row = brick / n, z = row / n;
    return view_bricks8(brick - row * n, row - z * n, z, volume, k, shape, T_c_g, margin_m);
}

/* How many pixels of a tile, columns first_x to last_x and rows first_y to last_y of it, have a depth within low_m to high_m. */
INLINE int count_depths_within(__global const float* depth_m, __global const uchar* sample_weights, const MapShape shape,
                               const int first_x, const int last_x, const int first_y, const int last_y, const float low_m,
                               const float high_m) {
    int8 count = (int8)(0);
    for (int y = first_y; y <= last_y; ++y) {
        for (int x = first_x & ~7; x <= last_x; x += 8) {
            const float8 z = load_weighted8(depth_m, sample_weights, y * shape.pitch_px + x);
            count -= (z > 0.0f) & (z >= low_m) & (z <= high_m);
        }
    }
    const int4 c4 = count.lo + count.hi;
    return c4.x + c4.y + c4.z + c4.w;
}

/* Adds the pixels of one tile per brick, where `wanted`, that are near the brick's depth; -1 for those that have enough. */
INLINE int8 enough_edge_pixels8(__global const float* depth_m, __global const uchar* sample_weights, const MapShape shape,
                                const BrickViews8* view, const int8 tile_x, const int8 tile_y, const float8 low_m,
                                const float8 high_m, const int8 wanted, int* edge_pixels) {
    int x0[8], x1[8], y0[8], y1[8], counted[8];
    float low[8], high[8];
    vstore8(max(tile_x * TILE_PX, view->first_x), 0, x0);
    vstore8(min(tile_x * TILE_PX + TILE_PX - 1, view->last_x), 0, x1);
    vstore8(max(tile_y * TILE_PX, view->first_y), 0, y0);
    vstore8(min(tile_y * TILE_PX + TILE_PX - 1, view->last_y), 0, y1);
    vstore8(low_m, 0, low);
    vstore8(high_m, 0, high);
    vstore8(wanted, 0, counted);
    for (int i = 0; i < 8; ++i) {
        if (counted[i])
            edge_pixels[i] += count_depths_within(depth_m, sample_weights, shape, x0[i], x1[i], y0[i], y1[i], low[i], high[i]);
    }
    return wanted & (vload8(0, edge_pixels) >= BRICK_EDGE_PIXELS);
}

/* Class of the bricks of every step-th layer from first_layer on along y against the tile ranges. Eight bricks along x a
 * work-item: global size (an eighth of bricks_per_side, layers, bricks_per_side), each rounded up. A tile with an edge in it
 * spans much depth: its pixels decide, and single ones, that fly between the edge's two sides, do not. */
__kernel void classify_bricks(__global const float* depth_m, __global const uchar* sample_weights, __global const float* ranges_m,
                              __global uchar* classes, const int first_layer, const int layers, const int step,
                              const VolumeParams volume, const Intrinsics k, const MapShape shape, const Pose T_c_g) {
    const int n = volume.bricks_per_side, x = (int)get_global_id(0) * 8, y = (int)get_global_id(1), z = (int)get_global_id(2);
    if (x >= n || z >= n) return;
    const int8 layer = (int8)(first_layer + step * y);
    const BrickViews8 view = view_bricks8(convert_int8(lanes8()) + x, layer, (int8)(z), volume, k, shape, T_c_g, 0.0f);
    const float8 low_m = view.near_m - volume.min_truncation_m, high_m = view.far_m + volume.max_truncation_m;
    const int8 tile_x = view.first_x / TILE_PX, tile_y = view.first_y / TILE_PX;
    const int8 columns = select((int8)(0), view.last_x / TILE_PX - tile_x + 1, view.last_x >= 0);
    const int8 rows = select((int8)(0), view.last_y / TILE_PX - tile_y + 1, view.last_y >= 0);
    int8 is_near = (int8)(0), is_free = (int8)(0);
    int edge_pixels[8] = {0, 0, 0, 0, 0, 0, 0, 0};
    for (int j = 0; any(~is_near & (j < rows)); ++j) {
        for (int i = 0; any(~is_near & (j < rows) & (i < columns)); ++i) {
            const int8 covered = ~is_near & (j < rows) & (i < columns);
            const int8 at = select((int8)(-1), 2 * ((tile_y + j) * (shape.pitch_px / TILE_PX) + tile_x + i), covered);
            const float8 nearest = gather8(ranges_m, at), farthest = gather8(ranges_m, at + (covered & 1));
            const int8 measured = covered & (farthest > 0.0f) & (farthest >= low_m), within = measured & (nearest <= high_m);
            const int8 is_wide = farthest - nearest > volume.max_truncation_m;
            is_free |= measured;
            is_near |= within & ~is_wide;
            if (any(within & is_wide)) {
                is_near |= enough_edge_pixels8(depth_m, sample_weights, shape, &view, tile_x + i, tile_y + j, low_m, high_m,
                                               within & is_wide, edge_pixels);
            }
        }
    }
    const uchar8 result = convert_uchar8(select(select((int8)(BRICK_HIDDEN), (int8)(BRICK_FREE_SPACE), is_free),
                                                (int8)(BRICK_NEAR_SURFACE), is_near));
    __global uchar* row = classes + (z * layers + y) * n + x;
    if (x + 8 <= n) {
        vstore8(result, 0, row);
        return;
    }
    uchar rest[8];
    vstore8(result, 0, rest);
    for (int i = 0; x + i < n; ++i) row[i] = rest[i];
}

/* The tiles of eight bricks, lane by lane. */
typedef struct BrickTiles {
    int first_x[8], last_x[8], first_y[8], last_y[8];
} BrickTiles;

INLINE BrickTiles tiles_of8(const BrickViews8* view) {
    BrickTiles tiles;
    vstore8(view->first_x / TILE_PX, 0, tiles.first_x);
    vstore8(view->first_y / TILE_PX, 0, tiles.first_y);
    vstore8(select((int8)(-1), view->last_x / TILE_PX, view->last_x >= 0), 0, tiles.last_x);
    vstore8(select((int8)(-1), view->last_y / TILE_PX, view->last_y >= 0), 0, tiles.last_y);
    return tiles;
}

/* Raises the flag of every tile whose rays can read a voxel of the given bricks. Eight bricks a work-item. */
__kernel void flag_brick_tiles(__global const int* bricks, const int count, __global uchar* flags, const VolumeParams volume,
                               const Intrinsics k, const MapShape shape, const Pose T_c_g) {
    const int first = (int)get_global_id(0) * 8;
    if (first >= count) return;
    const BrickViews8 view = view_listed8(bricks, first, count, volume, k, shape, T_c_g, 2.0f * volume.voxel_m);
    const BrickTiles tiles = tiles_of8(&view);
    for (int i = 0; i < 8; ++i) {
        for (int ty = tiles.first_y[i]; ty <= tiles.last_y[i]; ++ty) {
            for (int tx = tiles.first_x[i]; tx <= tiles.last_x[i]; ++tx) flags[ty * (shape.pitch_px / TILE_PX) + tx] = 1;
        }
    }
}

/* Where rays of each tile start and end, as the bits of positive floats: over the bricks that hold a point behind a surface,
 * two voxels wider, so that a ray meets the last positive voxel first. Eight bricks a work-item. */
__kernel void brick_range_image(__global const int* bricks, const int count, __global const uchar* has_inside,
                                __global int* nearest, __global int* farthest, const VolumeParams volume, const Intrinsics k,
                                const MapShape shape, const Pose T_c_g) {
    const int first = (int)get_global_id(0) * 8;
    if (first >= count) return;
    const BrickViews8 view = view_listed8(bricks, first, count, volume, k, shape, T_c_g, 2.0f * volume.voxel_m);
    const BrickTiles tiles = tiles_of8(&view);
    int near_bits[8], far_bits[8];
    vstore8(as_int8(view.near_m), 0, near_bits);
    vstore8(as_int8(view.far_m), 0, far_bits);
    for (int i = 0; i < 8 && first + i < count; ++i) {
        if (!has_inside[first + i]) continue;
        for (int ty = tiles.first_y[i]; ty <= tiles.last_y[i]; ++ty) {
            for (int tx = tiles.first_x[i]; tx <= tiles.last_x[i]; ++tx) {
                const int tile = ty * (shape.pitch_px / TILE_PX) + tx;
                if (near_bits[i] < nearest[tile]) atomic_min(nearest + tile, near_bits[i]);
                if (far_bits[i] > farthest[tile]) atomic_max(farthest + tile, far_bits[i]);
            }
        }
    }
}
