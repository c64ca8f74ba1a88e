/* Listing 3, the part that predicts the surface: depth, normal and weight per pixel of a view, for a list of tiles.
 * t is the depth z of the ray's point (PAPER.md#5). */

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

/* Eight rays on their way, in voxel units. */
typedef struct Walk8 {
    Points8 direction;
    float8 per_voxel[3]; /* depth over which a ray passes a voxel along each axis */
    float8 voxel_step;   /* depth over a voxel's length along the ray */
    float8 t, t_before, before;
    int8 live;
    Crossing8 crossing;
} Walk8;

INLINE Walk8 start_walk8(const Points8 direction, const float8 voxel_step, const float start, const float end) {
    Walk8 w;
    w.direction = direction;
    w.per_voxel[0] = 1.0f / fmax(fabs(direction.x), 1e-3f);
    w.per_voxel[1] = 1.0f / fmax(fabs(direction.y), 1e-3f);
    w.per_voxel[2] = 1.0f / fmax(fabs(direction.z), 1e-3f);
    w.voxel_step = voxel_step;
    w.t = w.t_before = (float8)(start);  // L3:5 L3:6
    w.before = w.crossing.before = w.crossing.after = w.crossing.share = (float8)(0.0f);
    w.crossing.found = (int8)(0);
    w.live = (int8)(start < end ? -1 : 0);
    return w;
}

/* Depth over which the rays stay in the brick that they are in. */
INLINE float8 rest_of_brick8(const Walk8* w, const Points8 p) {
    const float side = BRICK_VOX;
    const float8 x = p.x - side * floor(p.x / side), y = p.y - side * floor(p.y / side);
    const float8 z = p.z - side * floor(p.z / side);
    const float8 along_x = select(x, side - x, w->direction.x > 0.0f) * w->per_voxel[0];
    const float8 along_y = select(y, side - y, w->direction.y > 0.0f) * w->per_voxel[1];
    const float8 along_z = select(z, side - z, w->direction.z > 0.0f) * w->per_voxel[2];
    return fmin(fmin(along_x, along_y), along_z);
}

/* One step towards where the TSDF changes from positive to negative. Unknown voxels never make a crossing, and absent bricks are
 * passed at once; from negative to positive means that the ray comes from behind: it ends. */
INLINE void step_walk8(__global const int* table, __global const int* pool, const VolumeParams volume, const Points8 origin,
                       const float end, Walk8* w) {
    const float scale = 0.8f * volume.max_truncation_m / volume.voxel_m;
    const Points8 p = ray_points8(origin, w->direction, w->t);
    const float size = (float)volume.size_vox;
    // L3:9
    const int8 inside = (p.x >= 0.0f) & (p.y >= 0.0f) & (p.z >= 0.0f) & (p.x < size) & (p.y < size) & (p.z < size);
    const int8 x = convert_int8_rtz(select((float8)(0.0f), p.x, inside));
    const int8 y = convert_int8_rtz(select((float8)(0.0f), p.y, inside));
    const int8 z = convert_int8_rtz(select((float8)(0.0f), p.z, inside));
    const int8 slot = gather_int8(table, select((int8)(-1), brick_of8(volume, x, y, z), inside));
    const int8 voxel = read_slots8(pool, slot, x, y, z);  // L3:12
    const int8 known = voxel_weight8(voxel) > 0;
    const float8 tsdf = select((float8)(0.0f), voxel_tsdf8(voxel), known);
    const int8 hit = w->live & known & (tsdf <= 0.0f) & (w->before > 0.0f);  // L3:13
    w->crossing.before = select(w->crossing.before, w->t_before, hit);
    w->crossing.after = select(w->crossing.after, w->t, hit);
    w->crossing.share = select(w->crossing.share, w->before / (w->before - tsdf), hit);
    w->crossing.found |= hit;
    w->live &= ~hit & ~(known & (tsdf > 0.0f) & (w->before < 0.0f));
    w->t_before = w->t;
    w->before = tsdf;  // L3:11
    float8 step = w->voxel_step * select((float8)(2.0f), fmax(1.0f, scale * tsdf), known);
    if (any(w->live & (slot < 0))) step = select(step, fmax(step, rest_of_brick8(w, p)), slot < 0);
    w->t += step;
    w->live &= w->t < end;
}

typedef struct Refinement8 {
    float8 t;
    Points8 gradient;
    int8 resting, ok;
} Refinement8;

INLINE Refinement8 start_refinement8(const Crossing8 c) {
    Refinement8 r;
    r.t = c.before + (c.after - c.before) * c.share;
    r.gradient.x = r.gradient.y = r.gradient.z = (float8)(0.0f);
    r.resting = ~c.found;
    r.ok = (int8)(0);
    return r;
}

/* From the walk's crossing towards the zero of the trilinear TSDF: a Newton step along the ray, whose slope the sample's gradient
 * gives, of at most a voxel. Rays that have come to a tenth of a voxel rest, and those that are where a neighbour is unknown; -1 in
 * ok where the surface is at most half a voxel away. */
INLINE void refine8(__global const int* table, __global const int* pool, const VolumeParams volume, const Points8 origin,
                    const Walk8* w, Refinement8* r) {
    const float tolerance = 0.1f * volume.voxel_m / volume.max_truncation_m;
    const Sample8 s = sample_trilinear8(table, pool, volume, ray_points8(origin, w->direction, r->t));
    const float8 slope = dot8(s.gradient, w->direction);
    const int8 descends = s.known & (slope < -1e-6f);
    const float8 newton = clamp(-s.tsdf / select((float8)(-1.0f), slope, descends), -w->voxel_step, w->voxel_step);
    const float8 step = select(select((float8)(0.0f), -0.5f * w->voxel_step, s.known), newton, descends);
    const int8 searching = ~r->resting, arrived = descends & (fabs(s.tsdf) < 5.0f * tolerance);
    r->ok = select(r->ok, arrived | (s.known & (fabs(s.tsdf) < 5.0f * tolerance)), searching);
    r->t += select((float8)(0.0f), step, searching);
    r->gradient.x = select(r->gradient.x, s.gradient.x, searching);
    r->gradient.y = select(r->gradient.y, s.gradient.y, searching);
    r->gradient.z = select(r->gradient.z, s.gradient.z, searching);
    r->resting |= arrived | ~s.known;
}

/* Depth and normal of eight pixels; 0 and the zero vector where there is no surface. */
INLINE void store_surface8(const Refinement8 r, const Points8 ray_c, const Pose T_g_c, const MapShape shape, const int x,
                           const int y, __global float* depth_m, __global float* normals_c) {
    // The gradient is the normal (L3:16); R^T turns it into the camera frame.
    Points8 n;
    n.x = T_g_c.row_x.x * r.gradient.x + T_g_c.row_y.x * r.gradient.y + T_g_c.row_z.x * r.gradient.z;
    n.y = T_g_c.row_x.y * r.gradient.x + T_g_c.row_y.y * r.gradient.y + T_g_c.row_z.y * r.gradient.z;
    n.z = T_g_c.row_x.z * r.gradient.x + T_g_c.row_y.z * r.gradient.y + T_g_c.row_z.z * r.gradient.z;
    const int8 hit = r.ok & (dot8(n, ray_c) < 0.0f);
    const float8 scale = select((float8)(0.0f), rsqrt(fmax(dot8(n, n), 1e-20f)), hit);
    const int8 in_picture = (lanes8() + (float)x < (float)shape.width_px) & (int8)(y < shape.height_px ? -1 : 0);
    const int plane = shape.pitch_px * shape.rows_px, at = y * shape.pitch_px + x;
    vstore8(select((float8)(0.0f), r.t, hit & in_picture), 0, depth_m + at);  // L3:15
    vstore8(n.x * scale, 0, normals_c + at);
    vstore8(n.y * scale, 0, normals_c + plane + at);
    vstore8(n.z * scale, 0, normals_c + 2 * plane + at);
}

/* A work-group is a tile, a work-item a row of it: two times eight rays, as each waits for memory most of the time. */
__kernel void raycast(__global const int* tiles, __global const int* tile_near, __global const int* tile_far,
                      __global const int* table, __global const int* pool, const VolumeParams volume, const Intrinsics k,
                      const MapShape shape, const Pose T_g_c, __global float* depth_m, __global float* normals_c) {
    const int tile = tiles[get_group_id(0)], per_row = shape.pitch_px / TILE_PX;
    // L3:1
    const int x = tile % per_row * TILE_PX, y = tile / per_row * TILE_PX + (int)get_local_id(0);
    const float start = as_float(tile_near[tile]), end = as_float(tile_far[tile]);
    const float to_vox = 1.0f / volume.voxel_m;
    const Points8 ray_a = pixel_rays8(k, x, y), ray_b = pixel_rays8(k, x + 8, y);
    Pose T_vox_c = T_g_c;  // L3:2
    T_vox_c.row_x *= to_vox, T_vox_c.row_y *= to_vox, T_vox_c.row_z *= to_vox;
    Points8 origin;
    origin.x = (float8)(T_vox_c.row_x.w), origin.y = (float8)(T_vox_c.row_y.w), origin.z = (float8)(T_vox_c.row_z.w);
    // L3:3 L3:4
    Walk8 a = start_walk8(rotate_vectors8(T_vox_c, ray_a), volume.voxel_m * rsqrt(dot8(ray_a, ray_a)), start, end);
    Walk8 b = start_walk8(rotate_vectors8(T_vox_c, ray_b), volume.voxel_m * rsqrt(dot8(ray_b, ray_b)), start, end);
    for (int step = 0; step < 4096 && any(a.live | b.live); ++step) {  // L3:10
        step_walk8(table, pool, volume, origin, end, &a);
        step_walk8(table, pool, volume, origin, end, &b);
    }
    Refinement8 at_a = start_refinement8(a.crossing), at_b = start_refinement8(b.crossing);
    for (int i = 0; i < 6 && !all(at_a.resting & at_b.resting); ++i) {  // L3:14
        refine8(table, pool, volume, origin, &a, &at_a);
        refine8(table, pool, volume, origin, &b, &at_b);
    }
    store_surface8(at_a, ray_a, T_g_c, shape, x, y, depth_m, normals_c);
    store_surface8(at_b, ray_b, T_g_c, shape, x + 8, y, depth_m, normals_c);
}
