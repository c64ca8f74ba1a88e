/* Listing 3, the part that predicts the surface: depth, normal and weight per pixel of a view, for a list of tiles.
 * A work-group is one 16x16 tile, a work-item eight rays along x. t is the depth z of the ray's point (PAPER.md#5). */

typedef struct Crossing8 {
    float8 before, after; /* depths of the last positive sample and the first that is not */
    float8 share;         /* of the way between them, where a straight line is zero */
    int8 found;
} Crossing8;

INLINE Points8 ray_points8(const Points8 origin, const Points8 direction, const float8 t) {
    Points8 p;
    p.x = origin.x + direction.x * t;
    p.y = origin.y + direction.y * t;
    p.z = origin.z + direction.z * t;
    return p;
}

/* Walks rays in voxel units from t to end until the TSDF changes from positive to negative. Unknown voxels never make
 * a crossing; from negative to positive means that the ray comes from behind: it ends. */
INLINE Crossing8 walk8(__global const int* table, __global const int* pool, const VolumeParams volume,
                       const Points8 origin, const Points8 direction, const float8 voxel_step, const float start,
                       const float end) {
    Crossing8 crossing;
    crossing.before = crossing.after = crossing.share = (float8)(0.0f);
    crossing.found = (int8)(0);
    const float scale = 0.8f * volume.max_truncation_m / volume.voxel_m;
    const float size = (float)volume.size_vox;
    float8 t = (float8)(start), t_before = t, before = (float8)(0.0f);  // L3:5 L3:6
    int8 live = (int8)(-1);
    for (int step = 0; step < 4096 && any(live); ++step) {  // L3:10
        const Points8 p = ray_points8(origin, direction, t);
        // L3:9
        const int8 inside = (p.x >= 0.0f) & (p.y >= 0.0f) & (p.z >= 0.0f) & (p.x < size) & (p.y < size) & (p.z < size);
        const int8 x = convert_int8_rtz(select((float8)(0.0f), p.x, inside));
        const int8 y = convert_int8_rtz(select((float8)(0.0f), p.y, inside));
        const int8 z = convert_int8_rtz(select((float8)(0.0f), p.z, inside));
        const int8 voxel = read_voxels8(table, pool, volume, x, y, z);  // L3:12
        const int8 known = inside & (voxel_weight8(voxel) > 0);
        const float8 tsdf = select((float8)(0.0f), voxel_tsdf8(voxel), known);
        const int8 hit = live & known & (tsdf <= 0.0f) & (before > 0.0f);  // L3:13
        crossing.before = select(crossing.before, t_before, hit);
        crossing.after = select(crossing.after, t, hit);
        crossing.share = select(crossing.share, before / (before - tsdf), hit);
        crossing.found |= hit;
        live &= ~hit & ~(known & (tsdf > 0.0f) & (before < 0.0f));
        t_before = t;
        before = tsdf;  // L3:11
        const float8 known_step = fmax(1.0f, scale * tsdf);
        t += voxel_step * select((float8)(2.0f), known_step, known);
        live &= t < end;
    }
    return crossing;
}

/* From the walk's crossing to the zero of the trilinear TSDF by Newton steps along the ray, whose slope the sample's
 * gradient gives; a step is at most a voxel. Rays that have come to a tenth of a voxel rest; -1 in ok where in the end the
 * surface is at most half a voxel away. */
INLINE float8 refine8(__global const int* table, __global const int* pool, const VolumeParams volume,
                      const Points8 origin, const Points8 direction, const float8 voxel_step, const Crossing8 c,
                      Points8* gradient, int8* ok) {
    const float tolerance = 0.1f * volume.voxel_m / volume.max_truncation_m;
    const float8 most = voxel_step;
    float8 t = c.before + (c.after - c.before) * c.share;
    int8 arrived = (int8)(0);
    *ok = (int8)(0);
    for (int i = 0; i < 6 && !all(arrived | ~c.found); ++i) {
        const Sample8 s = sample_trilinear8(table, pool, volume, ray_points8(origin, direction, t));
        const float8 slope = dot8(s.gradient, direction);
        const int8 descends = s.known & (slope < -1e-6f);
        const float8 newton = clamp(-s.tsdf / select((float8)(-1.0f), slope, descends), -most, most);
        const float8 step = select(select((float8)(0.0f), -0.5f * most, s.known), newton, descends);
        const int8 searching = ~arrived;
        arrived |= descends & (fabs(s.tsdf) < tolerance);
        *ok = arrived | (s.known & (fabs(s.tsdf) < 5.0f * tolerance));
        t += select((float8)(0.0f), step, searching);
        gradient->x = select(gradient->x, s.gradient.x, searching);
        gradient->y = select(gradient->y, s.gradient.y, searching);
        gradient->z = select(gradient->z, s.gradient.z, searching);
    }
    return t;
}

__kernel void raycast(__global const int* tiles, __global const int* tile_near, __global const int* tile_far,
                      __global const int* table, __global const int* pool, const VolumeParams volume, const Intrinsics k,
                      const MapShape shape, const Pose T_g_c, __global float* depth_m, __global float* normals_c) {
    const int tile = tiles[get_group_id(0)], item = (int)get_local_id(0), per_row = shape.pitch_px / TILE_PX;
    // L3:1
    const int x = tile % per_row * TILE_PX + (item & 1) * 8, y = tile / per_row * TILE_PX + (item >> 1);
    const float start = as_float(tile_near[tile]), end = as_float(tile_far[tile]);
    const float to_vox = 1.0f / volume.voxel_m;
    const Points8 ray_c = pixel_rays8(k, x, y);
    Points8 direction = rotate_vectors8(T_g_c, ray_c);  // L3:3 L3:4
    direction.x *= to_vox, direction.y *= to_vox, direction.z *= to_vox;
    Points8 origin;  // L3:2
    origin.x = (float8)(T_g_c.row_x.w * to_vox);
    origin.y = (float8)(T_g_c.row_y.w * to_vox);
    origin.z = (float8)(T_g_c.row_z.w * to_vox);
    float8 depth = (float8)(0.0f);
    Points8 n = {depth, depth, depth};
    if (start < end) {
        const float8 voxel_step = volume.voxel_m * rsqrt(dot8(ray_c, ray_c));
        const Crossing8 crossing = walk8(table, pool, volume, origin, direction, voxel_step, start, end);
        Points8 gradient = n;
        int8 ok;
        const float8 t = refine8(table, pool, volume, origin, direction, voxel_step, crossing, &gradient, &ok);  // L3:14
        // The gradient is the normal (L3:16); R^T turns it into the camera frame.
        n.x = T_g_c.row_x.x * gradient.x + T_g_c.row_y.x * gradient.y + T_g_c.row_z.x * gradient.z;
        n.y = T_g_c.row_x.y * gradient.x + T_g_c.row_y.y * gradient.y + T_g_c.row_z.y * gradient.z;
        n.z = T_g_c.row_x.z * gradient.x + T_g_c.row_y.z * gradient.y + T_g_c.row_z.z * gradient.z;
        const float8 length2 = dot8(n, n);
        const int8 hit = crossing.found & ok & (dot8(n, ray_c) < 0.0f);
        const float8 scale = select((float8)(0.0f), rsqrt(fmax(length2, 1e-20f)), hit);
        n.x *= scale, n.y *= scale, n.z *= scale;
        const float8 columns = lanes8() + (float)x;
        const int8 in_picture = (columns < (float)shape.width_px) & (int8)(y < shape.height_px ? -1 : 0);
        depth = select((float8)(0.0f), t, hit & in_picture);  // L3:15
    }
    const int plane = shape.pitch_px * shape.rows_px, at = y * shape.pitch_px + x;
    vstore8(depth, 0, depth_m + at);
    vstore8(n.x, 0, normals_c + at);
    vstore8(n.y, 0, normals_c + plane + at);
    vstore8(n.z, 0, normals_c + 2 * plane + at);
}
