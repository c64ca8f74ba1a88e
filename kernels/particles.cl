/* Particles (Fig 7, 9, 13): spheres that collide by spring, dashpot and shear with one another, with still spheres that stand for
 * the foreground, and with the TSDF of the background itself. The paper takes still spheres for the background, too: the field gives
 * its distance and normal smoothly, at any resolution, and is always up to date (PAPER.md).
 * Planes of a state: x, y, z metres, vx, vy, vz metres a second, global frame; eight values to spare behind each. */

INLINE int8 cell8(const float8 position_m, const float cell_m) { return convert_int8_rtn(position_m * (1.0f / cell_m)); }

/* Key of the cell of a uniform grid without end: cells that are 128 (z: 8) apart share one, and distances tell them apart. */
INLINE int8 cell_key8(const int8 x, const int8 y, const int8 z) {
    return (x & 127) | ((y & 127) << 7) | ((z & 7) << 14);
}

/* Keys and places of eight particles a work-item. */
__kernel void find_cells(__global const float* state, __global int* keys, __global int* places, const int plane, const float cell_m) {
    const int at = (int)get_global_id(0) * 8;
    __global const float* p = state + at;
    const int8 key = cell_key8(cell8(vload8(0, p), cell_m), cell8(vload8(0, p + plane), cell_m), cell8(vload8(0, p + 2 * plane), cell_m));
    vstore8(key, 0, keys + at);
    vstore8(convert_int8(lanes8()) + at, 0, places + at);
}

/* The state in the order of the keys, and where each key's particles start; one particle a work-item. */
__kernel void order_by_cell(__global const float* state, __global const int* ids, __global const int* keys, __global const int* places,
                            __global float* sorted, __global int* sorted_ids, __global int* starts, const int plane, const int count) {
    const int i = (int)get_global_id(0);
    if (i >= count) return;
    const int from = places[i];
    for (int k = 0; k < 6; ++k) sorted[k * plane + i] = state[k * plane + from];
    sorted_ids[i] = ids[from];
    for (int key = i > 0 ? keys[i - 1] + 1 : 0; key <= keys[i]; ++key) starts[key] = i;
    if (i == count - 1)
        for (int key = keys[i] + 1; key <= PARTICLE_CELLS; ++key) starts[key] = count;
}

typedef struct Sphere {
    float4 position_m, velocity;
} Sphere;

INLINE Sphere load_sphere(__global const float* state, const int plane, const int i) {
    Sphere s;
    s.position_m = (float4)(state[i], state[plane + i], state[2 * plane + i], 0.0f);
    s.velocity = (float4)(state[3 * plane + i], state[4 * plane + i], state[5 * plane + i], 0.0f);
    return s;
}

/* Accelerations by a contact at depth_m along the unit vector n, which points to the particle; v: its velocity against the other's.
 * Spring and dashpot push and never pull; shear slows what slides, by Coulomb's share of the push at most. */
INLINE Points8 contact8(const ParticleParams params, const float8 depth_m, const Points8 n, const Points8 v, const int8 touching) {
    const float8 apart = dot8(v, n);
    const float8 push = select((float8)(0.0f), fmax(params.stiffness * depth_m - params.damping * apart, 0.0f), touching);
    const Points8 slide = {v.x - apart * n.x, v.y - apart * n.y, v.z - apart * n.z};
    const float8 drag = select((float8)(0.0f), fmin(params.shear, params.friction * push * rsqrt(dot8(slide, slide) + 1e-12f)), touching);
    const Points8 a = {push * n.x - drag * slide.x, push * n.y - drag * slide.y, push * n.z - drag * slide.z};
    return a;
}

/* Adds what the spheres first .. end - 1 of `others` do to one. */
INLINE void add_contacts8(const ParticleParams params, __global const float* others, const int plane, const int first, const int end,
                          const Sphere self, const int self_index, const float reach_m, Points8* sum) {
    const int8 lane = convert_int8(lanes8());
    for (int j = first; j < end; j += 8) {
        const Points8 p = load_points8(others + j, plane);
        const Points8 d = {self.position_m.x - p.x, self.position_m.y - p.y, self.position_m.z - p.z};
        const float8 square = dot8(d, d);
        const int8 touching = (lane < end - j) & (lane != self_index - j) & (square < reach_m * reach_m) & (square > 0.0f);
        if (!any(touching)) continue;
        const float8 inverse = rsqrt(fmax(square, 1e-12f));
        const Points8 n = {d.x * inverse, d.y * inverse, d.z * inverse};
        const Points8 w = load_points8(others + 3 * plane + j, plane);
        const Points8 v = {self.velocity.x - w.x, self.velocity.y - w.y, self.velocity.z - w.z};
        const Points8 a = contact8(params, reach_m - square * inverse, n, v, touching);
        sum->x += a.x;
        sum->y += a.y;
        sum->z += a.z;
    }
}

/* The 27 cells around one: runs of three along x, but where keys begin anew. */
INLINE void add_neighbours8(const ParticleParams params, __global const float* others, __global const int* starts, const int plane,
                            const float cell_m, const Sphere self, const int self_index, const float reach_m, Points8* sum) {
    const int4 cell = convert_int4_rtn(self.position_m * (1.0f / cell_m));
    const int x = cell.x & 127, in_one_run = x > 0 && x < 127;
    for (int row = 0; row < 9; ++row) {
        const int base = (((cell.y + row % 3 - 1) & 127) << 7) | (((cell.z + row / 3 - 1) & 7) << 14);
        if (in_one_run) {
            add_contacts8(params, others, plane, starts[base | (x - 1)], starts[(base | (x + 1)) + 1], self, self_index, reach_m, sum);
            continue;
        }
        for (int step = -1; step <= 1; ++step) {
            const int key = base | ((x + step) & 127);
            add_contacts8(params, others, plane, starts[key], starts[key + 1], self, self_index, reach_m, sum);
        }
    }
}

/* Accelerations (planes x, y, z) of particles, which are in the order of their cells, by one another and by the still ones. */
__kernel void collide(__global const float* state, __global const int* starts, __global const float* still,
                      __global const int* still_starts, __global float* acceleration, const ParticleParams params) {
    const int i = (int)get_global_id(0);
    if (i >= params.count) return;
    const Sphere self = load_sphere(state, params.plane, i);
    Points8 sum = {(float8)(0.0f), (float8)(0.0f), (float8)(0.0f)};
    add_neighbours8(params, state, starts, params.plane, params.cell_m, self, i, 2.0f * params.radius_m, &sum);
    const float reach_m = params.radius_m + params.still_radius_m;
    if (all(self.position_m.xyz > params.still_low_m.xyz - reach_m) && all(self.position_m.xyz < params.still_high_m.xyz + reach_m))
        add_neighbours8(params, still, still_starts, params.still_plane, params.still_cell_m, self, -1, reach_m, &sum);
    acceleration[i] = sum8(sum.x);
    acceleration[params.plane + i] = sum8(sum.y);
    acceleration[2 * params.plane + i] = sum8(sum.z);
}

/* A touch of the surface: along n, which points off it, the push is an acceleration. */
typedef struct SurfaceContact8 {
    Points8 n;
    float8 push;
} SurfaceContact8;

/* The first-order distance is the TSDF over the length of its gradient. */
INLINE SurfaceContact8 surface_contact8(__global const int* table, __global const int* pool, const VolumeParams volume,
                                        const ParticleParams params, const Points8 p, const Points8 v) {
    const float to_vox = 1.0f / volume.voxel_m;
    const Points8 p_vox = {p.x * to_vox, p.y * to_vox, p.z * to_vox};
    const Sample8 s = sample_trilinear8(table, pool, volume, p_vox);
    const float least = 0.2f * volume.voxel_m / volume.max_truncation_m;
    const float8 square = dot8(s.gradient, s.gradient);
    const int8 sloped = s.known & (square > least * least);
    const float8 inverse = rsqrt(select((float8)(1.0f), square, sloped));
    const float8 depth_m = params.radius_m - s.tsdf * inverse * volume.voxel_m;
    SurfaceContact8 c;
    c.n.x = s.gradient.x * inverse, c.n.y = s.gradient.y * inverse, c.n.z = s.gradient.z * inverse;
    const float8 push = fmax(params.stiffness * depth_m - params.damping * dot8(v, c.n), 0.0f);
    c.push = select((float8)(0.0f), push, sloped & (depth_m > 0.0f));
    return c;
}

/* Coulomb's friction takes from what slides as much as there is: what it can hold lies still. */
INLINE Points8 hold_by_friction8(const ParticleParams params, const SurfaceContact8 c, const Points8 v) {
    const float8 along = dot8(v, c.n);
    const Points8 slide = {v.x - along * c.n.x, v.y - along * c.n.y, v.z - along * c.n.z};
    const float8 held = fmin(1.0f, params.friction * params.dt_s * c.push * rsqrt(dot8(slide, slide) + 1e-12f));
    const Points8 r = {v.x - held * slide.x, v.y - held * slide.y, v.z - held * slide.z};
    return r;
}

/* A wall at distance_m along an axis, in the direction of which v is. */
INLINE float8 wall8(const ParticleParams params, const float8 distance_m, const float8 v) {
    const float8 depth_m = params.radius_m - distance_m;
    return select((float8)(0.0f), fmax(params.stiffness * depth_m - params.damping * v, 0.0f), depth_m > 0.0f);
}

INLINE float8 walls8(const ParticleParams params, const float8 p, const float8 v, const float low_m, const float high_m) {
    return wall8(params, p - low_m, v) - wall8(params, high_m - p, -v);
}

/* Adds the surface, the walls of the box and gravity, and moves particles on: semi-implicit Euler. Eight a work-item. */
__kernel void move(__global float* state, __global const float* acceleration, __global const int* table, __global const int* pool,
                   const VolumeParams volume, const ParticleParams params) {
    const int at = (int)get_global_id(0) * 8;
    Points8 p = load_points8(state + at, params.plane), v = load_points8(state + 3 * params.plane + at, params.plane);
    Points8 a = load_points8(acceleration + at, params.plane);
    SurfaceContact8 c = {{(float8)(0.0f), (float8)(0.0f), (float8)(0.0f)}, (float8)(0.0f)};
    if (params.has_surface) {
        c = surface_contact8(table, pool, volume, params, p, v);
        a.x += c.push * c.n.x, a.y += c.push * c.n.y, a.z += c.push * c.n.z;
    }
    a.x += params.gravity.x + walls8(params, p.x, v.x, params.low_m.x, params.high_m.x);
    a.y += params.gravity.y + walls8(params, p.y, v.y, params.low_m.y, params.high_m.y);
    a.z += params.gravity.z + walls8(params, p.z, v.z, params.low_m.z, params.high_m.z);
    v.x += a.x * params.dt_s, v.y += a.y * params.dt_s, v.z += a.z * params.dt_s;
    v = hold_by_friction8(params, c, v);
    const float8 slower = fmin(1.0f, params.max_speed * rsqrt(dot8(v, v) + 1e-12f));
    v.x *= slower, v.y *= slower, v.z *= slower;
    vstore8(p.x + v.x * params.dt_s, 0, state + at);
    vstore8(p.y + v.y * params.dt_s, 0, state + params.plane + at);
    vstore8(p.z + v.z * params.dt_s, 0, state + 2 * params.plane + at);
    vstore8(v.x, 0, state + 3 * params.plane + at);
    vstore8(v.y, 0, state + 4 * params.plane + at);
    vstore8(v.z, 0, state + 5 * params.plane + at);
}
