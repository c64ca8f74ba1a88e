/* Colours of the voxels near the surface (Fig 1C, 6A): which pixels may give their colour, which bricks hold a surface, and the
 * running average. A colour is one uint: red, green, blue, weight (0 = none) from the lowest byte up. */

/* Depths at columns x + dx ... of a row; beyond its ends the last one again. */
INLINE float8 load_shifted8(__global const float* row, const int x, const int dx, const MapShape shape) {
    const int first = x + dx;
    if (first >= 0 && first + 8 <= shape.pitch_px) return vload8(0, row + first);
    return gather8(row, clamp((int8)(first) + convert_int8(lanes8()), 0, shape.pitch_px - 1));
}

/* The pixels' sample weights, less where seen aslant, and 0 where the angle is more than min_cos allows, or where within
 * guard_px, where every second row and column is looked at, a depth differs by more than such a surface could. Eight pixels a work-item; global size (pitch / 8, rows). */
__kernel void color_weights(__global const float* depth_m, __global const float* normals_c, __global const uchar* sample_weights,
                            __global uchar* weights, const MapShape shape, const Intrinsics k, const ColorParams params) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1), plane = shape.pitch_px * shape.rows_px;
    const int at = y * shape.pitch_px + x;
    const float8 z = vload8(0, depth_m + at), sample_weight = convert_float8(vload8(0, sample_weights + at));
    const Points8 n = {vload8(0, normals_c + at), vload8(0, normals_c + plane + at), vload8(0, normals_c + 2 * plane + at)};
    const Points8 ray = pixel_rays8(k, x, y);
    const float8 cos_theta = -dot8(n, ray) * rsqrt(dot8(ray, ray));
    int8 used = (z > 0.0f) & (sample_weight > 0.0f) & (cos_theta > params.min_cos);
    const float slope_per_px = sqrt(1.0f - params.min_cos * params.min_cos) / (params.min_cos * k.fx_px);
    for (int j = -params.guard_px; j <= params.guard_px && any(used); j += 2) {
        if (y + j < 0 || y + j >= shape.height_px) continue;
        __global const float* row = depth_m + (y + j) * shape.pitch_px;
        for (int i = -params.guard_px; i <= params.guard_px; i += 2) {
            const float8 other = load_shifted8(row, x, i, shape);
            const float8 allowed = z * (params.gap_per_m + slope_per_px * (float)(abs(i) + abs(j)));
            used &= (other <= 0.0f) | (fabs(other - z) <= allowed);
        }
    }
    const float8 weight = fmax(1.0f, sample_weight * cos_theta);
    vstore8(convert_uchar8(convert_int8_rte(select((float8)(0.0f), weight, used))), 0, weights + at);
}

INLINE int8 is_near_surface8(const int8 voxel, const VolumeParams volume, const float band_m) {
    return (voxel_weight8(voxel) > 0) & (fabs(voxel_tsdf8(voxel)) * volume.max_truncation_m < band_m);
}

/* Raises the flag of each listed slot that has a voxel near the surface. A work-group is one brick, a work-item a row. */
__kernel void find_surface_bricks(__global const int* slots, __global const int* pool, __global uchar* flags,
                                  const VolumeParams volume, const ColorParams params) {
    const int brick = (int)get_group_id(0), row = (int)get_local_id(0);
    const int8 voxel = vload8(0, pool + slots[brick] * BRICK_VOXELS + row * BRICK_VOX);
    if (any(is_near_surface8(voxel, volume, params.band_vox * volume.voxel_m))) flags[brick] = 1;
}

INLINE float8 gather_channel8(__global const uchar* rgb, const int8 i) {
    return (float8)(rgb[i.s0], rgb[i.s1], rgb[i.s2], rgb[i.s3], rgb[i.s4], rgb[i.s5], rgb[i.s6], rgb[i.s7]);
}

/* The old average of one channel counts at most seven times as much as the sample: 8 bits cannot hold smaller steps. */
INLINE uint8 average_channel8(const uint8 old, const int shift, const float8 sample, const float8 old_weight, const float8 weight) {
    const float8 value = convert_float8((old >> (uint8)(shift)) & (uint8)(0xff));
    const float8 average = (value * old_weight + sample * weight) / (old_weight + weight);
    return convert_uint8(convert_int8_rte(average)) << (uint8)(shift);
}

/* places: brick, slot and colour slot of each brick. A work-group is one brick, a work-item a row of eight voxels. */
__kernel void integrate_colors(__global const int* places, __global const int* pool, __global uint* color_pool,
                               __global const float* depth_m, __global const uchar* weights, __global const uchar* rgb,
                               const VolumeParams volume, const ColorParams params, const Intrinsics k, const MapShape shape,
                               const Pose T_c_g) {
    __global const int* place = places + 3 * get_group_id(0);
    const int brick = place[0], row = (int)get_local_id(0), n = volume.bricks_per_side;
    const float band_m = params.band_vox * volume.voxel_m;
    const int8 near = is_near_surface8(vload8(0, pool + place[1] * BRICK_VOXELS + row * BRICK_VOX), volume, band_m);
    if (!any(near)) return;
    Points8 v_g;
    v_g.x = (lanes8() + ((float)(brick % n * BRICK_VOX) + 0.5f)) * volume.voxel_m;
    v_g.y = (float8)(((float)(brick / n % n * BRICK_VOX + (row & 7)) + 0.5f) * volume.voxel_m);
    v_g.z = (float8)(((float)(brick / (n * n) * BRICK_VOX + (row >> 3)) + 0.5f) * volume.voxel_m);
    const Points8 v_c = transform_points8(T_c_g, v_g);
    const int8 pixel = select((int8)(-1), project_to_index8(k, shape, v_c), near);
    const float8 measured_m = gather8(depth_m, pixel);
    const float8 weight = select((float8)(0.0f), convert_float8(gather_uchar8(weights, pixel)), pixel >= 0);
    // Seen now, and not something before or behind it.
    const float8 reach_m = fmax(band_m, 3.0f * sigma_z8(params.noise, measured_m));
    const int8 used = (weight > 0.0f) & (fabs(measured_m - v_c.z) < reach_m);
    if (!any(used)) return;
    __global uint* colors = color_pool + place[2] * BRICK_VOXELS + row * BRICK_VOX;
    const uint8 old = vload8(0, colors), stored_weight = old >> (uint8)(24);
    const float8 old_weight = fmin(convert_float8(stored_weight), 7.0f * weight), safe = fmax(weight, 1.0f);
    const int8 picture_row = max(pixel, 0) / shape.pitch_px;
    const int8 at = 3 * (picture_row * shape.width_px + max(pixel, 0) - picture_row * shape.pitch_px);
    const uint8 average = average_channel8(old, 0, gather_channel8(rgb, at), old_weight, safe) |
                          average_channel8(old, 8, gather_channel8(rgb, at + 1), old_weight, safe) |
                          average_channel8(old, 16, gather_channel8(rgb, at + 2), old_weight, safe);
    const uint8 new_weight = min(stored_weight + convert_uint8(weight), (uint8)(255));
    vstore8(select(old, average | (new_weight << (uint8)(24)), used), 0, colors);
}
