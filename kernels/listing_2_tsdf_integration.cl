/* Listing 2: projective TSDF integration of one masked depth picture, brick by brick instead of slice by slice
 * (PAPER.md#3). A work-group is one brick. */

/* Behind the surface a sample is a measurement as far as its noise reaches, at least a voxel; deeper it is a guess, as nobody
 * knows how thick a thing is, and weighs 1 from twice as deep on. Free space weighs 1, too: what is seen past a thin thing's
 * edge must not wear it away. */
INLINE int8 weight_along_ray8(const int8 weight, const float8 sdf_m, const float8 guess_m, const int8 is_free) {
    const float8 share = clamp(2.0f + sdf_m / guess_m, 0.0f, 1.0f);
    return select(max(convert_int8_rte(convert_float8(weight) * share), 1), (int8)(1), is_free);
}

/* What eight voxels of a row of a brick see of the depth picture. */
typedef struct Sight8 {
    int8 pixel; /* index into the maps, -1 = outside the picture */
    Points8 v_c;
    float8 measured_m, lambda; /* lambda: the ray's length over its depth */
} Sight8;

/* Camera points of the first row of eight voxels of a brick's slice `layer`. */
INLINE Points8 first_row8(const int brick, const int layer, const VolumeParams volume, const Pose T_c_g) {
    const int n = volume.bricks_per_side;
    Points8 v_g;
    v_g.x = (lanes8() + ((float)(brick % n * BRICK_VOX) + 0.5f)) * volume.voxel_m;
    v_g.y = (float8)(((float)(brick / n % n * BRICK_VOX) + 0.5f) * volume.voxel_m);
    v_g.z = (float8)(((float)(brick / (n * n) * BRICK_VOX + layer) + 0.5f) * volume.voxel_m);  // L2:3
    return transform_points8(T_c_g, v_g);                                                        // L2:4
}

/* What the voxels `row` rows on see. */
INLINE Sight8 see_voxels8(__global const float* depth_m, const Points8 first, const int row, const VolumeParams volume,
                          const Intrinsics k, const MapShape shape, const Pose T_c_g) {
    const float step_m = (float)row * volume.voxel_m;
    Sight8 sight;
    sight.v_c.x = first.x + T_c_g.row_x.y * step_m;
    sight.v_c.y = first.y + T_c_g.row_y.y * step_m;
    sight.v_c.z = first.z + T_c_g.row_z.y * step_m;
    const int8 ahead = sight.v_c.z > 0.05f;
    const float8 inverse_z = 1.0f / select((float8)(1.0f), sight.v_c.z, ahead);
    const float8 a = sight.v_c.x * inverse_z, b = sight.v_c.y * inverse_z;
    const float8 u = a * k.fx_px + (k.cx_px + 0.5f), v = b * k.fy_px + (k.cy_px + 0.5f);
    const int8 inside = ahead & (u >= 0.0f) & (v >= 0.0f) & (u < (float)shape.width_px) & (v < (float)shape.height_px);
    const int8 column = convert_int8_rtz(select((float8)(0.0f), u, inside));
    const int8 line = convert_int8_rtz(select((float8)(0.0f), v, inside));
    sight.pixel = select((int8)(-1), line * shape.pitch_px + column, inside);  // L2:5
    sight.measured_m = gather8(depth_m, sight.pixel);
    // It makes both distances lengths along the ray; positive in front (PAPER.md#1).
    sight.lambda = sqrt(1.0f + (a * a + b * b));
    return sight;
}

/* A work-item is a slice of a brick. */
__kernel void integrate(__global const int* slots, __global const int* brick_of_slot, __global int* pool,
                        __global uchar* has_inside, __global const float* depth_m, __global const uchar* sample_weights,
                        const VolumeParams volume, const SensorNoise noise, const Intrinsics k, const MapShape shape,
                        const Pose T_c_g) {
    const int slot = slots[get_group_id(0)], layer = (int)get_local_id(0);
    const Points8 first = first_row8(brick_of_slot[slot], layer, volume, T_c_g);
    const float to_tsdf = 1.0f / volume.max_truncation_m;
    int8 any_inside = (int8)(0);
    for (int row = 0; row < BRICK_VOX; ++row) {
        const Sight8 sight = see_voxels8(depth_m, first, row, volume, k, shape, T_c_g);  // L2:6
        const float8 measured_m = sight.measured_m, sdf_m = sight.lambda * (measured_m - sight.v_c.z);  // L2:7
        // Behind the surface stays unknown, and both sides share one scale (PAPER.md#2).
        const int8 reached = (measured_m > 0.0f) & (sdf_m > -volume.min_truncation_m);  // L2:10
        if (!any(reached)) continue;
        const int8 pixel_weight = convert_int8(gather_uchar8(sample_weights, sight.pixel));
        const int8 sampled = reached & (pixel_weight > 0);
        if (!any(sampled)) continue;
        const float8 tsdf = fmin(1.0f, sdf_m * to_tsdf);  // L2:8 L2:9 L2:11
        __global int* voxels = pool + slot * BRICK_VOXELS + (layer * BRICK_VOX + row) * BRICK_VOX;
        const int8 old = vload8(0, voxels), stored_weight = voxel_weight8(old);
        const float8 old_tsdf = voxel_tsdf8(old);
        const int8 is_free = sdf_m >= volume.max_truncation_m;
        const float8 guess_m = fmax(3.0f * sigma_z8(noise, measured_m), volume.voxel_m);
        const int8 sample_weight = weight_along_ray8(pixel_weight, sdf_m, guess_m, is_free);
        // In front of a surface free space tells nothing new, and what another side's surface lets guess is not believed.
        const int8 is_guess = (sdf_m < -guess_m) & (pixel_weight > 1);
        const int8 used = sampled & ~((is_free | is_guess) & (old_tsdf > 0.0f) & (old_tsdf < 1.0f));
        // Free space where a thing was: the thing left. Each such frame takes a quarter of the old weight.
        const int8 old_weight = select(stored_weight, (stored_weight * 3) >> 2, is_free & (old_tsdf <= 0.0f));
        const int8 weight = min(old_weight + sample_weight, volume.max_weight);  // L2:12
        const float8 old_weight_f = convert_float8(old_weight), sample_weight_f = convert_float8(sample_weight);
        // The stored weight weighs the average, the new sample its own (PAPER.md#4).
        const float8 average = (old_tsdf * old_weight_f + tsdf * sample_weight_f) / (old_weight_f + sample_weight_f);  // L2:13
        const int8 packed = pack_voxels8(average, weight, (old >> 24) & 0xff);
        vstore8(select(old, packed, used), 0, voxels);  // L2:14
        any_inside |= used & (average <= 0.0f);
    }
    if (any(any_inside)) has_inside[slot] = 1;
}

#define ONE_SURFACE_PER_M 0.015f

/* Depth between the four pixels around each point where they are of one surface, within ONE_SURFACE_PER_M z of each other; else
 * the nearest pixel's. Without it what moves across the pixels' grid is rough by the slope times half a pixel. */
INLINE float8 measure_between8(__global const float* depth_m, const Sight8 sight, const Intrinsics k,
                               const MapShape shape) {
    const float8 inverse_z = 1.0f / select((float8)(1.0f), sight.v_c.z, sight.pixel >= 0);
    const float8 u = sight.v_c.x * inverse_z * k.fx_px + k.cx_px, v = sight.v_c.y * inverse_z * k.fy_px + k.cy_px;
    const int8 inside = (sight.pixel >= 0) & (u >= 0.0f) & (v >= 0.0f) & (u < (float)(shape.width_px - 1)) &
                        (v < (float)(shape.height_px - 1));
    const float8 left = floor(select((float8)(0.0f), u, inside)), top = floor(select((float8)(0.0f), v, inside));
    const float8 a = select((float8)(0.0f), u, inside) - left, b = select((float8)(0.0f), v, inside) - top;
    const int8 at = select((int8)(-1), convert_int8_rtz(top) * shape.pitch_px + convert_int8_rtz(left), inside);
    const int8 right = select((int8)(-1), at + 1, inside), below = select((int8)(-1), at + shape.pitch_px, inside);
    const int8 across = select((int8)(-1), at + shape.pitch_px + 1, inside);
    const float8 z00 = gather8(depth_m, at), z10 = gather8(depth_m, right);
    const float8 z01 = gather8(depth_m, below), z11 = gather8(depth_m, across);
    const float8 nearest = fmin(fmin(z00, z10), fmin(z01, z11)), farthest = fmax(fmax(z00, z10), fmax(z01, z11));
    const int8 together = (nearest > 0.0f) & (farthest - nearest < ONE_SURFACE_PER_M * nearest);
    return select(sight.measured_m, mix(mix(z00, z10, a), mix(z01, z11, a), b), together);
}

/* The same for a volume that moves with what it holds, and all of its bricks (get_group_id(0) is the slot): how much the
 * stored average counts follows from how much it changed of late. What is seen through is gone at once: that is a large
 * change. Sets has_inside anew. */
__kernel void integrate_moving(__global const int* brick_of_slot, __global int* pool, __global uchar* has_inside,
                               __global const float* depth_m, __global const uchar* sample_weights, const VolumeParams volume,
                               const AdaptiveWeightParams adaptive, const SensorNoise noise, const Intrinsics k,
                               const MapShape shape, const Pose T_c_g) {
    const int slot = (int)get_group_id(0), row = (int)get_local_id(0);
    __global int* voxels = pool + slot * BRICK_VOXELS + row * BRICK_VOX;
    const int8 old = vload8(0, voxels), stored_weight = voxel_weight8(old);
    const Points8 first = first_row8(brick_of_slot[slot], row >> 3, volume, T_c_g);
    const Sight8 sight = see_voxels8(depth_m, first, row & 7, volume, k, shape, T_c_g);
    const int8 pixel_weight = convert_int8(gather_uchar8(sample_weights, sight.pixel));
    // A depth between four pixels differs from the nearest pixel's by less than slack_m along the ray.
    const float8 slack_m = sight.lambda * (ONE_SURFACE_PER_M * sight.measured_m);
    const float8 nearest_sdf_m = sight.lambda * (sight.measured_m - sight.v_c.z);
    const int8 reached = (sight.pixel >= 0) & (sight.measured_m > 0.0f) & (pixel_weight > 0) &
                         (nearest_sdf_m > -volume.min_truncation_m - slack_m);
    if (!any(reached)) {
        if (any((stored_weight > 0) & (voxel_tsdf8(old) <= 0.0f))) has_inside[slot] = 1;
        return;
    }
    const bool is_near = any(reached & (nearest_sdf_m < volume.max_truncation_m + slack_m));
    const float8 measured_m = is_near ? measure_between8(depth_m, sight, k, shape) : sight.measured_m;
    const float8 sdf_m = sight.lambda * (measured_m - sight.v_c.z);
    const int8 is_free = sdf_m >= volume.max_truncation_m;
    const int8 used = (sight.pixel >= 0) & (measured_m > 0.0f) & (pixel_weight > 0) &
                      (sdf_m > -volume.min_truncation_m) & (is_free | (pixel_weight != SAMPLE_FREE_ONLY));
    const float8 old_tsdf = voxel_tsdf8(old), tsdf = fmin(1.0f, sdf_m / volume.max_truncation_m);
    const float8 sigma_m = sigma_z8(noise, measured_m);
    const int8 sample_weight = weight_along_ray8(pixel_weight, sdf_m, fmax(3.0f * sigma_m, volume.voxel_m), is_free);
    const float8 difference = select((float8)(0.0f), tsdf - old_tsdf, stored_weight > 0);
    const float8 old_change = convert_float8(old >> 24) * (1.0f / CHANGE_SCALE);
    const float8 change = old_change + (difference - old_change) * adaptive.change_share;
    const float8 sigmas = fabs(change) * volume.max_truncation_m / sigma_m;
    const float8 calm = clamp((adaptive.moving_sigmas - sigmas) / (adaptive.moving_sigmas - adaptive.calm_sigmas), 0.0f, 1.0f);
    const float range = (float)(volume.max_weight - adaptive.least_weight);
    const int8 most = adaptive.least_weight + convert_int8_rte(range * calm * calm);
    const int8 old_weight = min(stored_weight, most), weight = min(old_weight + sample_weight, volume.max_weight);
    const float8 old_weight_f = convert_float8(old_weight), sample_weight_f = convert_float8(sample_weight);
    const float8 average = (old_tsdf * old_weight_f + tsdf * sample_weight_f) / (old_weight_f + sample_weight_f);
    const int8 packed = pack_voxels8(average, weight, convert_int8_rte(clamp(change, -1.0f, 1.0f) * CHANGE_SCALE));
    const int8 result = select(old, packed, used);
    vstore8(result, 0, voxels);
    if (any((voxel_weight8(result) > 0) & (voxel_tsdf8(result) <= 0.0f))) has_inside[slot] = 1;
}
