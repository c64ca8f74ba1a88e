/* Which bricks a depth picture touches, and which part of the picture a brick covers: no rays, no holes. */

/* Nearest and farthest valid depth of each 16x16 tile (0, 0 where there is none). One tile a work-item. */
__kernel void depth_tile_ranges(__global const float* depth_m, __global float2* ranges_m, const MapShape shape) {
    const int tile_x = (int)get_global_id(0), tile_y = (int)get_global_id(1);
    float8 nearest = (float8)(FLT_MAX), farthest = (float8)(0.0f);
    for (int j = 0; j < TILE_PX; ++j) {
        __global const float* row = depth_m + (tile_y * TILE_PX + j) * shape.pitch_px + tile_x * TILE_PX;
        for (int i = 0; i < TILE_PX; i += 8) {
            const float8 z = vload8(0, row + i);
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
    int4 tiles; /* first and last tile in x, then in y; empty where .y < .x */
    float near_m, far_m;
} BrickView;

/* Depth range and tiles of the sphere around a brick, grown by margin_m. A brick that reaches the camera is left out. */
inline BrickView view_brick(const int brick, const VolumeParams volume, const Intrinsics k, const MapShape shape,
                            const Pose T_c_g, const float margin_m) {
    const int n = volume.bricks_per_side;
    const float side_m = volume.voxel_m * BRICK_VOX;
    const float gx = ((float)(brick % n) + 0.5f) * side_m, gy = ((float)(brick / n % n) + 0.5f) * side_m;
    const float gz = ((float)(brick / (n * n)) + 0.5f) * side_m;
    const float cx = T_c_g.row_x.x * gx + T_c_g.row_x.y * gy + T_c_g.row_x.z * gz + T_c_g.row_x.w;
    const float cy = T_c_g.row_y.x * gx + T_c_g.row_y.y * gy + T_c_g.row_y.z * gz + T_c_g.row_y.w;
    const float cz = T_c_g.row_z.x * gx + T_c_g.row_z.y * gy + T_c_g.row_z.z * gz + T_c_g.row_z.w;
    const float radius_m = 0.8660254f * side_m + margin_m;
    BrickView view;
    view.near_m = cz - radius_m;
    view.far_m = cz + radius_m;
    view.tiles = (int4)(0, -1, 0, -1);
    if (!(view.near_m > 0.05f)) return view;
    const float2 low = (float2)(k.fx_px * (cx - radius_m), k.fy_px * (cy - radius_m));
    const float2 high = (float2)(k.fx_px * (cx + radius_m), k.fy_px * (cy + radius_m));
    const float2 center = (float2)(k.cx_px, k.cy_px);
    const float2 first = fmin(low / view.near_m, low / view.far_m) + center;
    const float2 last = fmax(high / view.near_m, high / view.far_m) + center;
    const float2 size = (float2)((float)shape.width_px, (float)shape.height_px);
    if (!(first.x < size.x && first.y < size.y && last.x >= 0.0f && last.y >= 0.0f)) return view;
    const int2 a = convert_int2_rtz(fmax(first, 0.0f)) / TILE_PX;
    const int2 b = convert_int2_rtz(fmin(last, size - 1.0f)) / TILE_PX;
    view.tiles = (int4)(a.x, b.x, a.y, b.y);
    return view;
}

/* Class of the bricks of the layers first_layer ... along y against the tile ranges. One brick a work-item: global size
 * (bricks_per_side, layers, bricks_per_side). */
__kernel void classify_bricks(__global const float2* ranges_m, __global uchar* classes, const int first_layer,
                              const VolumeParams volume, const Intrinsics k, const MapShape shape, const Pose T_c_g) {
    const int n = volume.bricks_per_side, x = (int)get_global_id(0), z = (int)get_global_id(2);
    const int brick = (z * n + first_layer + (int)get_global_id(1)) * n + x;
    const BrickView view = view_brick(brick, volume, k, shape, T_c_g, 0.0f);
    const int tiles_per_row = shape.pitch_px / TILE_PX;
    uchar result = BRICK_HIDDEN;
    for (int ty = view.tiles.z; ty <= view.tiles.w && result != BRICK_NEAR_SURFACE; ++ty) {
        for (int tx = view.tiles.x; tx <= view.tiles.y; ++tx) {
            const float2 range = ranges_m[ty * tiles_per_row + tx];
            if (range.y <= 0.0f || view.near_m > range.y + volume.min_truncation_m) continue;
            if (view.far_m >= range.x - volume.max_truncation_m) {
                result = BRICK_NEAR_SURFACE;
                break;
            }
            result = BRICK_FREE_SPACE;
        }
    }
    classes[(z * (int)get_global_size(1) + (int)get_global_id(1)) * n + x] = result;
}

/* Raises the flag of every tile whose rays can read a voxel of the given bricks. One brick a work-item. */
__kernel void flag_brick_tiles(__global const int* bricks, __global uchar* flags, const VolumeParams volume,
                               const Intrinsics k, const MapShape shape, const Pose T_c_g) {
    const BrickView view = view_brick(bricks[get_global_id(0)], volume, k, shape, T_c_g, 2.0f * volume.voxel_m);
    for (int ty = view.tiles.z; ty <= view.tiles.w; ++ty) {
        for (int tx = view.tiles.x; tx <= view.tiles.y; ++tx) flags[ty * (shape.pitch_px / TILE_PX) + tx] = 1;
    }
}

/* Nearest and farthest depth of the bricks over each tile, as the bits of positive floats: ray starts and ends. */
__kernel void brick_range_image(__global const int* bricks, __global int* nearest, __global int* farthest,
                                const VolumeParams volume, const Intrinsics k, const MapShape shape, const Pose T_c_g) {
    const BrickView view = view_brick(bricks[get_global_id(0)], volume, k, shape, T_c_g, 0.0f);
    for (int ty = view.tiles.z; ty <= view.tiles.w; ++ty) {
        for (int tx = view.tiles.x; tx <= view.tiles.y; ++tx) {
            const int tile = ty * (shape.pitch_px / TILE_PX) + tx;
            atomic_min(nearest + tile, as_int(view.near_m));
            atomic_max(farthest + tile, as_int(view.far_m));
        }
    }
}
