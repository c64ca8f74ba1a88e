/* Secondary rays through a volume: how far they clear all surfaces, and the first one that they meet. Rays are in the global frame, in
 * voxel units, eight a work-item. */

typedef struct Ray8 {
    Points8 origin, direction; /* length 1 */
    float8 enter, leave;       /* of the box that holds all surfaces: enter >= 0, leave < enter where it is missed */
} Ray8;

INLINE Points8 scaled8(const Points8 p, const float8 by) {
    const Points8 r = {p.x * by, p.y * by, p.z * by};
    return r;
}

/* p + d t */
INLINE Points8 along8(const Points8 p, const Points8 d, const float8 t) {
    const Points8 r = {p.x + d.x * t, p.y + d.y * t, p.z + d.z * t};
    return r;
}

INLINE Points8 normalized8(const Points8 p) { return scaled8(p, rsqrt(fmax(dot8(p, p), 1e-20f))); }

INLINE Points8 choose_points8(const Points8 otherwise, const Points8 where_set, const int8 mask) {
    const Points8 r = {select(otherwise.x, where_set.x, mask), select(otherwise.y, where_set.y, mask),
                       select(otherwise.z, where_set.z, mask)};
    return r;
}

INLINE void clip_axis8(const float8 origin, const float8 direction, const float low, const float high, float8* enter,
                       float8* leave) {
    const float8 per_voxel = 1.0f / copysign(fmax(fabs(direction), 1e-6f), direction);
    const float8 a = (low - origin) * per_voxel, b = (high - origin) * per_voxel;
    *enter = fmax(*enter, fmin(a, b));
    *leave = fmin(*leave, fmax(a, b));
}

INLINE Ray8 make_ray8(const Points8 origin, const Points8 direction, const ViewLightingParams params) {
    const float4 low = params.low_vox, high = params.high_vox;
    Ray8 ray = {origin, direction, (float8)(0.0f), (float8)(1e9f)};
    clip_axis8(origin.x, direction.x, low.x, high.x, &ray.enter, &ray.leave);
    clip_axis8(origin.y, direction.y, low.y, high.y, &ray.enter, &ray.leave);
    clip_axis8(origin.z, direction.z, low.z, high.z, &ray.enter, &ray.leave);
    return ray;
}

/* What is left along an axis of the cells of this side, and a little, so that rounding does not keep a ray in them. */
INLINE float8 rest_along8(const float8 p, const float8 direction, const float8 side) {
    const float8 in_cell = p - side * floor(p / side);
    return (select(in_cell, side - in_cell, direction > 0.0f) + 0.01f) / fmax(fabs(direction), 1e-3f);
}

typedef struct Look8 {
    float8 distance; /* to the surface, voxels, negative behind it; 0 where unknown */
    float8 step;     /* that passes nothing */
    int8 known;
} Look8;

/* The voxels at t. Bricks that are not in the table are passed at once, and so are groups of them. */
INLINE Look8 look8(__global const int* table, __global const int* pool, const VolumeParams volume, const Ray8* ray, const float8 t,
                   const int8 live) {
    const float last = (float)volume.size_vox - 0.5f, truncation_vox = volume.max_truncation_m / volume.voxel_m;
    const Points8 p = along8(ray->origin, ray->direction, t);
    const int8 x = convert_int8_rtz(fmax(fmin(p.x, last), 0.0f)), y = convert_int8_rtz(fmax(fmin(p.y, last), 0.0f));
    const int8 z = convert_int8_rtz(fmax(fmin(p.z, last), 0.0f));
    const int8 slot = gather_int8(table, select((int8)(-1), brick_of8(volume, x, y, z), live));
    const int8 voxel = read_slots8(pool, slot, x, y, z);
    Look8 r;
    r.known = voxel_weight8(voxel) > 0;
    r.distance = select((float8)(0.0f), voxel_tsdf8(voxel) * truncation_vox, r.known);
    r.step = select((float8)(2.0f), fmax(1.0f, 0.8f * r.distance), r.known);
    const int8 passed = live & (slot < 0);
    if (any(passed)) {
        const float8 side = select((float8)(BRICK_VOX), (float8)(SKIP_GROUP_BRICKS * BRICK_VOX), slot == SKIP_GROUP);
        const float8 rest = fmin(fmin(rest_along8(p.x, ray->direction.x, side), rest_along8(p.y, ray->direction.y, side)),
                                 rest_along8(p.z, ray->direction.z, side));
        r.step = select(r.step, fmax(r.step, rest), passed);
    }
    return r;
}

/* By how many voxels rays clear all surfaces up to `end`, from -0.5 (they do not) to 1. Whatever is known to be behind a surface is in the
 * way, from whichever side the ray comes; unknown space is not. */
INLINE float8 clearance8(__global const int* table, __global const int* pool, const VolumeParams volume, const Ray8* ray,
                         const float8 end, const int8 wanted) {
    const float truncation_vox = volume.max_truncation_m / volume.voxel_m;
    float8 t = ray->enter, clearance = (float8)(1.0f);
    int8 live = wanted & (t < end);
    for (int i = 0; i < 4096 && any(live); ++i) {
        const Look8 at = look8(table, pool, volume, ray, t, live);
        float8 distance = at.distance;
        /* The nearest voxel's centre is up to 0.87 voxels away: only so near can the clearance be below a half. */
        const int8 close = live & at.known & (distance < 1.5f);
        if (any(close)) {
            const Sample8 s = sample_trilinear8(table, pool, volume, along8(ray->origin, ray->direction, t));
            distance = select(distance, s.tsdf * truncation_vox, close & s.known);
        }
        clearance = select(clearance, fmin(clearance, distance), live & at.known);
        t += select(at.step, (float8)(0.5f), close);
        live &= (clearance > -0.5f) & (t < end);
    }
    return clearance;
}

/* The same of a sphere, as the distance of the nearest point of the segment. */
INLINE float8 sphere_clearance8(const Points8 from, const Points8 direction, const float8 length, const float4 sphere_vox) {
    const Points8 to_centre = {sphere_vox.x - from.x, sphere_vox.y - from.y, sphere_vox.z - from.z};
    const Points8 gap = along8(to_centre, direction, -clamp(dot8(to_centre, direction), (float8)(0.0f), length));
    return select((float8)(1.0f), sqrt(dot8(gap, gap)) - sphere_vox.w, (int8)(sphere_vox.w > 0.0f ? -1 : 0));
}

typedef struct Hit8 {
    float8 t;
    Points8 normal; /* length 1 */
    int8 found;
} Hit8;

/* The first surface that rays come to from its front, as the primary rays do: a walk and Newton steps towards the zero. */
INLINE Hit8 first_hit8(__global const int* table, __global const int* pool, const VolumeParams volume, const Ray8* ray,
                       const int8 wanted) {
    const float8 none = (float8)(0.0f);
    Hit8 hit = {none, {none, none, none}, (int8)(0)};
    float8 t = ray->enter, t_before = t, before = none;
    int8 live = wanted & (t < ray->leave);
    for (int i = 0; i < 4096 && any(live); ++i) {
        const Look8 at = look8(table, pool, volume, ray, t, live);
        const int8 crossed = live & at.known & (at.distance <= 0.0f) & (before > 0.0f);
        hit.t = select(hit.t, t_before + (t - t_before) * (before / (before - at.distance)), crossed);
        hit.found |= crossed;
        live &= ~crossed & ~(at.known & (at.distance > 0.0f) & (before < 0.0f));
        t_before = t;
        before = at.distance;
        t += at.step;
        live &= t < ray->leave;
    }
    const float truncation_vox = volume.max_truncation_m / volume.voxel_m;
    int8 near = (int8)(0), searching = hit.found;
    for (int i = 0; i < 6 && any(searching); ++i) {
        const Sample8 s = sample_trilinear8(table, pool, volume, along8(ray->origin, ray->direction, hit.t));
        const float8 slope = dot8(s.gradient, ray->direction);
        const int8 descends = s.known & (slope < -1e-6f);
        const float8 newton = clamp(-s.tsdf / select((float8)(-1.0f), slope, descends), (float8)(-1.0f), (float8)(1.0f));
        hit.t += select(none, select(select(none, (float8)(-0.5f), s.known), newton, descends), searching);
        hit.normal = choose_points8(hit.normal, s.gradient, searching);
        near = select(near, s.known & (fabs(s.tsdf) * truncation_vox < 0.5f), searching);
        searching &= s.known & ~(descends & (fabs(s.tsdf) * truncation_vox < 0.1f));
    }
    hit.normal = normalized8(hit.normal);
    hit.found &= near & (dot8(hit.normal, ray->direction) < 0.0f);
    return hit;
}
