/* Listing 2: projective TSDF integration of one masked depth picture, brick by brick instead of slice by slice
 * (PAPER.md#3). A work-group is one brick; a work-item is one row of eight voxels along x. */

__kernel void integrate(__global const int* slots, __global const int* brick_of_slot, __global int* pool,
                        __global uchar* has_inside, __global const float* depth_m, __global const uchar* mask, const VolumeParams volume,
                        const Intrinsics k, const MapShape shape, const Pose T_c_g) {
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
    const int8 masked = convert_int8(gather_uchar8(mask, pixel)) != 0;
    // The ray's length over its depth makes both distances lengths along the ray; positive in front (PAPER.md#1).
    const float8 inverse_z = 1.0f / fmax(v_c.z, 0.05f);
    const float8 lambda = sqrt(1.0f + (v_c.x * v_c.x + v_c.y * v_c.y) * inverse_z * inverse_z);
    const float8 sdf_m = lambda * (measured_m - v_c.z);  // L2:7
    // Behind the surface stays unknown, and both sides share one scale (PAPER.md#2).
    const int8 used = (pixel >= 0) & (measured_m > 0.0f) & ~masked & (sdf_m > -volume.min_truncation_m);  // L2:10
    if (!any(used)) return;
    const float8 tsdf = fmin(1.0f, sdf_m / volume.max_truncation_m);  // L2:8 L2:9 L2:11
    __global int* voxels = pool + slot * BRICK_VOXELS + row * BRICK_VOX;
    const int8 old = vload8(0, voxels);
    const int8 old_weight = voxel_weight8(old);
    const int8 weight = min(old_weight + 1, volume.max_weight);  // L2:12
    const float8 old_weight_f = convert_float8(old_weight);
    // The stored weight weighs the average, the new sample counts once (PAPER.md#4).
    const float8 average = (voxel_tsdf8(old) * old_weight_f + tsdf) / (old_weight_f + 1.0f);  // L2:13
    const int8 packed = pack_voxels8(average, weight, (old >> 24) & 0xff);
    vstore8(select(old, packed, used), 0, voxels);  // L2:14
    if (any(used & (average <= 0.0f))) has_inside[slot] = 1;
}
