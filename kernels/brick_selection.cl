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

typedef struct BrickView {
    int4 pixels; /* first and last column, first and last row */
    int4 tiles;  /* the same in tiles; empty where .y < .x */
    float near_m, far_m;
} BrickView;

/* Half the extent along one camera axis of a cube of the global frame with half-side h. */
INLINE float half_extent(const float4 row, const float h) { return h * (fabs(row.x) + fabs(row.y) + fabs(row.z)); }

/* Depth range and tiles of the box around a cube with half-side half_m, parallel to the camera's axes. One that reaches the
 * camera is left out. */
INLINE BrickView view_cube(const float4 center_g, const float half_m, const Intrinsics k, const MapShape shape, const Pose T_c_g) {
    const float2 center = (float2)(dot(T_c_g.row_x, center_g), dot(T_c_g.row_y, center_g));
    const float depth_m = dot(T_c_g.row_z, center_g);
    const float2 extent = (float2)(half_extent(T_c_g.row_x, half_m), half_extent(T_c_g.row_y, half_m));
    BrickView view;
    view.near_m = depth_m - half_extent(T_c_g.row_z, half_m);
    view.far_m = depth_m + half_extent(T_c_g.row_z, half_m);
    view.pixels = view.tiles = (int4)(0, -1, 0, -1);
    if (!(view.near_m > 0.05f)) return view;
    const float2 focal = (float2)(k.fx_px, k.fy_px), principal = (float2)(k.cx_px, k.cy_px);
    const float2 low = focal * (center - extent), high = focal * (center + extent);
    const float2 first = fmin(low / view.near_m, low / view.far_m) + principal - 0.5f;
    const float2 last = fmax(high / view.near_m, high / view.far_m) + principal + 0.5f;
    const float2 size = (float2)((float)shape.width_px, (float)shape.height_px);
    if (!(first.x < size.x && first.y < size.y && last.x >= 0.0f && last.y >= 0.0f)) return view;
    const int2 a = convert_int2_rtz(fmax(first, 0.0f)), b = convert_int2_rtz(fmin(last, size - 1.0f));
    view.pixels = (int4)(a.x, b.x, a.y, b.y);
    view.tiles = view.pixels / TILE_PX;
    return view;
}

/* The middle of a cube of `bricks` bricks along each side, of which (x, y, z) is the first. */
INLINE float4 cube_center(const int x, const int y, const int z, const int bricks, const VolumeParams volume) {
    const float side_m = volume.voxel_m * BRICK_VOX, half_side = 0.5f * (float)bricks;
    return (float4)(((float)x + half_side) * side_m, ((float)y + half_side) * side_m, ((float)z + half_side) * side_m, 1.0f);
}

/* Of a brick, grown by margin_m. */
INLINE BrickView view_brick(const int brick, const VolumeParams volume, const Intrinsics k, const MapShape shape,
                            const Pose T_c_g, const float margin_m) {
    const int n = volume.bricks_per_side;
    const float4 center_g = cube_center(brick % n, brick / n % n, brick / (n * n), 1, volume);
    return view_cube(center_g, 0.5f * volume.voxel_m * BRICK_VOX + margin_m, k, shape, T_c_g);
}

/* How many pixels of a tile that the brick covers have a depth within low_m to high_m. */
INLINE int count_depths_within(__global const float* depth_m, __global const uchar* sample_weights, const MapShape shape,
                               const int tx, const int ty, const int4 pixels, const float low_m, const float high_m) {
    const int x0 = max(tx * TILE_PX, pixels.x & ~7), x1 = min(tx * TILE_PX + TILE_PX - 1, pixels.y);
    const int y0 = max(ty * TILE_PX, pixels.z), y1 = min(ty * TILE_PX + TILE_PX - 1, pixels.w);
    int8 count = (int8)(0);
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; x += 8) {
            const float8 z = load_weighted8(depth_m, sample_weights, y * shape.pitch_px + x);
            count -= (z > 0.0f) & (z >= low_m) & (z <= high_m);
        }
    }
    const int4 c4 = count.lo + count.hi;
    return c4.x + c4.y + c4.z + c4.w;
}

/* Class of a brick against the tile ranges. A tile with an edge in it spans much depth: its pixels decide, and single ones, that
 * fly between the edge's two sides, do not. */
INLINE uchar classify_brick(__global const float* depth_m, __global const uchar* sample_weights, __global const float2* ranges_m,
                            const BrickView view, const VolumeParams volume, const MapShape shape) {
    const int tiles_per_row = shape.pitch_px / TILE_PX;
    const float low_m = view.near_m - volume.min_truncation_m, high_m = view.far_m + volume.max_truncation_m;
    uchar result = BRICK_HIDDEN;
    int edge_pixels = 0;
    for (int ty = view.tiles.z; ty <= view.tiles.w; ++ty) {
        for (int tx = view.tiles.x; tx <= view.tiles.y; ++tx) {
            const float2 range = ranges_m[ty * tiles_per_row + tx];
            if (range.y <= 0.0f || range.y < low_m) continue;
            const bool wide = range.y - range.x > volume.max_truncation_m;
            if (range.x <= high_m && wide) {
                edge_pixels += count_depths_within(depth_m, sample_weights, shape, tx, ty, view.pixels, low_m, high_m);
            }
            if (range.x <= high_m && (!wide || edge_pixels >= BRICK_EDGE_PIXELS)) return BRICK_NEAR_SURFACE;
            result = BRICK_FREE_SPACE;
        }
    }
    return result;
}

/* Whether all bricks of a cube of them are hidden: out of the picture, or behind what is seen. Those that reach the camera are. */
INLINE bool is_hidden(__global const float2* ranges_m, const float4 center_g, const float half_m, const VolumeParams volume,
                      const Intrinsics k, const MapShape shape, const Pose T_c_g) {
    const BrickView view = view_cube(center_g, half_m, k, shape, T_c_g);
    if (!(view.near_m > 0.05f)) return view.far_m <= 0.05f;
    for (int ty = view.tiles.z; ty <= view.tiles.w; ++ty) {
        for (int tx = view.tiles.x; tx <= view.tiles.y; ++tx) {
            const float far_m = ranges_m[ty * (shape.pitch_px / TILE_PX) + tx].y;
            if (far_m > 0.0f && far_m >= view.near_m - volume.min_truncation_m) return false;
        }
    }
    return true;
}

/* Class of the bricks of the layers first_layer ... first_layer + layers - 1 along y. A cube of group^3 bricks a work-item, which
 * is mostly hidden as a whole: global size bricks_per_side, layers and bricks_per_side over group, rounded up. */
__kernel void classify_bricks(__global const float* depth_m, __global const uchar* sample_weights, __global const float2* ranges_m,
                              __global uchar* classes, const int first_layer, const int layers, const int group,
                              const VolumeParams volume, const Intrinsics k, const MapShape shape, const Pose T_c_g) {
    const int n = volume.bricks_per_side;
    const int x0 = (int)get_global_id(0) * group, x1 = min(x0 + group, n);
    const int y0 = (int)get_global_id(1) * group, y1 = min(y0 + group, layers);
    const int z0 = (int)get_global_id(2) * group, z1 = min(z0 + group, n);
    const float half_m = 0.5f * volume.voxel_m * BRICK_VOX;
    const float4 center_g = cube_center(x0, first_layer + y0, z0, group, volume);
    const bool hidden = is_hidden(ranges_m, center_g, group * half_m, volume, k, shape, T_c_g);
    for (int z = z0; z < z1; ++z) {
        for (int y = y0; y < y1; ++y) {
            for (int x = x0; x < x1; ++x) {
                const int at = (z * layers + y) * n + x;
                classes[at] = BRICK_HIDDEN;
                if (hidden) continue;
                const float4 brick_g = cube_center(x, first_layer + y, z, 1, volume);
                const BrickView view = view_cube(brick_g, half_m, k, shape, T_c_g);
                classes[at] = classify_brick(depth_m, sample_weights, ranges_m, view, volume, shape);
            }
        }
    }
}

/* Raises the flag of every tile whose rays can read a voxel of the given bricks. One brick a work-item. */
__kernel void flag_brick_tiles(__global const int* bricks, const int count, __global uchar* flags, const VolumeParams volume,
                               const Intrinsics k, const MapShape shape, const Pose T_c_g) {
    const int i = (int)get_global_id(0);
    if (i >= count) return;
    const BrickView view = view_brick(bricks[i], volume, k, shape, T_c_g, 2.0f * volume.voxel_m);
    for (int ty = view.tiles.z; ty <= view.tiles.w; ++ty) {
        for (int tx = view.tiles.x; tx <= view.tiles.y; ++tx) flags[ty * (shape.pitch_px / TILE_PX) + tx] = 1;
    }
}

/* Where rays of each tile start and end, as the bits of positive floats: over the bricks that hold a point behind a surface,
 * two voxels wider, so that a ray meets the last positive voxel first. One brick a work-item. */
__kernel void brick_range_image(__global const int* bricks, const int count, __global const uchar* has_inside,
                                __global int* nearest, __global int* farthest, const VolumeParams volume, const Intrinsics k,
                                const MapShape shape, const Pose T_c_g) {
    const int i = (int)get_global_id(0);
    if (i >= count || !has_inside[i]) return;
    const BrickView view = view_brick(bricks[i], volume, k, shape, T_c_g, 2.0f * volume.voxel_m);
    for (int ty = view.tiles.z; ty <= view.tiles.w; ++ty) {
        for (int tx = view.tiles.x; tx <= view.tiles.y; ++tx) {
            const int tile = ty * (shape.pitch_px / TILE_PX) + tx;
            atomic_min(nearest + tile, as_int(view.near_m));
            atomic_max(farthest + tile, as_int(view.far_m));
        }
    }
}
