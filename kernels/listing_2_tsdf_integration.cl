/* Listing 2: projective TSDF integration of one masked depth picture, brick by brick instead of slice by slice
 * (PAPER.md#3). A work-group is one brick; a work-item is one row of eight voxels along x. */

/* Behind the surface a sample is a measurement as far as its noise reaches, at least a voxel; deeper it is a guess, as nobody
 * knows how thick a thing is, and weighs 1 from twice as deep on. Free space weighs 1, too: what is seen past a thin thing's
 * edge must not wear it away. */
inline int8 weight_along_ray8(const int8 weight, const float8 sdf_m, const float8 guess_m, const int8 is_free) {
    const float8 share = clamp(2.0f + sdf_m / guess_m, 0.0f, 1.0f);
    return select(max(convert_int8_rte(convert_float8(weight) * share), 1), (int8)(1), is_free);
}

__kernel void integrate(__global const int* slots, __global const int* brick_of_slot, __global int* pool,
                        __global uchar* has_inside, __global const float* depth_m, __global const uchar* sample_weights,
                        const VolumeParams volume, const SensorNoise noise, const Intrinsics k, const MapShape shape,
                        const Pose T_c_g) {
    const int slot = slots[get_group_id(0)], row = (int)get_local_id(0);
    const int brick = brick_of_slot[slot], n = volume.bricks_per_side;
    Points8 v_g;
    v_g.x = (lanes8() + ((float)(brick % n * BRICK_VOX) + 0.5f)) * volume.voxel_m;
    v_g.y = (float8)(((float)(brick / n % n * BRICK_VOX + (row & 7)) + 0.5f) * volume.voxel_m);
    v_g.z = (float8)(((float)(brick / (n * n) * BRICK_VOX + (row >> 3)) + 0.5f) * volume.voxel_m);  // L2:3
    const Points8 v_c = transform_points8(T_c_g, v_g);                                              // L2:4
    const int8 pixel = project_to_index8(k, shape, v_c);                                            // L2:5
    if (!any(pixel >= 0)) return;                                                                   // L2:6
    const float8 measured_m = gather8(depth_m, pixel);
    const int8 pixel_weight = convert_int8(gather_uchar8(sample_weights, pixel));
    // The ray's length over its depth makes both distances lengths along the ray; positive in front (PAPER.md#1).
    const float8 inverse_z = 1.0f / fmax(v_c.z, 0.05f);
    const float8 lambda = sqrt(1.0f + (v_c.x * v_c.x + v_c.y * v_c.y) * inverse_z * inverse_z);
    const float8 sdf_m = lambda * (measured_m - v_c.z);  // L2:7
    // Behind the surface stays unknown, and both sides share one scale (PAPER.md#2).
    const int8 sampled = (pixel >= 0) & (measured_m > 0.0f) & (pixel_weight > 0) & (sdf_m > -volume.min_truncation_m);  // L2:10
    if (!any(sampled)) return;
    const float8 tsdf = fmin(1.0f, sdf_m / volume.max_truncation_m);  // L2:8 L2:9 L2:11
    __global int* voxels = pool + slot * BRICK_VOXELS + row * BRICK_VOX;
    const int8 old = vload8(0, voxels), stored_weight = voxel_weight8(old);
    const float8 old_tsdf = voxel_tsdf8(old);
    const int8 is_free = sdf_m >= volume.max_truncation_m;
    const float8 guess_m = fmax(3.0f * sigma_z8(noise, measured_m), volume.voxel_m);
    const int8 sample_weight = weight_along_ray8(pixel_weight, sdf_m, guess_m, is_free);
    // In front of a surface free space tells nothing new, and what another side's surface lets guess is not believed.
    const int8 is_guess = (sdf_m < -guess_m) & (pixel_weight > 1);
    const int8 used = sampled & ~((is_free | is_guess) & (old_tsdf > 0.0f) & (old_tsdf < 1.0f));
    // Free space where a thing was: the thing left. Each such frame takes a quarter of the old weight.
    const int8 old_weight = select(stored_weight, stored_weight * 3 / 4, is_free & (old_tsdf <= 0.0f));
    const int8 weight = min(old_weight + sample_weight, volume.max_weight);  // L2:12
    const float8 old_weight_f = convert_float8(old_weight), sample_weight_f = convert_float8(sample_weight);
    // The stored weight weighs the average, the new sample its own (PAPER.md#4).
    const float8 average = (old_tsdf * old_weight_f + tsdf * sample_weight_f) / (old_weight_f + sample_weight_f);  // L2:13
    const int8 packed = pack_voxels8(average, weight, (old >> 24) & 0xff);
    vstore8(select(old, packed, used), 0, voxels);  // L2:14
    if (any(used & (average <= 0.0f))) has_inside[slot] = 1;
}
