/* Bricks and voxels of a TSDF volume: position, sample, gradient. */
#ifndef TOUCHSTONE_TSDF_ACCESS_H
#define TOUCHSTONE_TSDF_ACCESS_H

INLINE float8 voxel_tsdf8(const int8 voxel) { return convert_float8((voxel << 16) >> 16) * (1.0f / TSDF_SCALE); }
INLINE int8 voxel_weight8(const int8 voxel) { return (voxel >> 16) & 0xff; }

INLINE int8 pack_voxels8(const float8 tsdf, const int8 weight, const int8 change) {
    const int8 value = convert_int8_rte(clamp(tsdf, -1.0f, 1.0f) * TSDF_SCALE);
    return (value & 0xffff) | (weight << 16) | (change << 24);
}

/* The bricks of eight voxels inside the cube. */
INLINE int8 brick_of8(const VolumeParams volume, const int8 x, const int8 y, const int8 z) {
    return ((z >> 3) * volume.bricks_per_side + (y >> 3)) * volume.bricks_per_side + (x >> 3);
}

INLINE int8 offset_in_brick8(const int8 x, const int8 y, const int8 z) {
    return ((z & 7) << 6) | ((y & 7) << 3) | (x & 7);
}

/* Voxels of eight cells in the bricks of these slots; 0, that is unknown, where a slot is negative: an absent brick. */
INLINE int8 read_slots8(__global const int* pool, const int8 slot, const int8 x, const int8 y, const int8 z) {
    const int8 present = slot >= 0;
    const int8 at = slot * BRICK_VOXELS + offset_in_brick8(x, y, z);
    return select((int8)(0), gather_int8(pool, select((int8)(-1), at, present)), present);
}

/* Voxels of eight cells (whole-number voxel coordinates); 0, that is unknown, outside the cube and in absent bricks. */
INLINE int8 read_voxels8(__global const int* table, __global const int* pool, const VolumeParams volume, const int8 x,
                         const int8 y, const int8 z) {
    const int n = volume.size_vox;
    const int8 inside = (x >= 0) & (y >= 0) & (z >= 0) & (x < n) & (y < n) & (z < n);
    const int8 slot = gather_int8(table, select((int8)(-1), brick_of8(volume, x, y, z), inside));
    return read_slots8(pool, slot, x, y, z);
}

typedef struct Cells8 {
    int8 v000, v100, v010, v110, v001, v101, v011, v111;
} Cells8;

/* The voxels at the corners of eight cells. A cell inside one brick takes one look at the table and reads its rows in pairs;
 * one lane after the other, as a gather is on a CPU anyway. */
INLINE Cells8 read_cells8(__global const int* table, __global const int* pool, const VolumeParams volume, const int8 x,
                          const int8 y, const int8 z) {
    const int n = volume.size_vox;
    const int8 inside = (x >= 0) & (y >= 0) & (z >= 0) & (x < n) & (y < n) & (z < n);
    const int8 whole = inside & ((x & 7) < 7) & ((y & 7) < 7) & ((z & 7) < 7);
    Cells8 c;
    if (!all(whole)) {
        c.v000 = read_voxels8(table, pool, volume, x, y, z);
        c.v100 = read_voxels8(table, pool, volume, x + 1, y, z);
        c.v010 = read_voxels8(table, pool, volume, x, y + 1, z);
        c.v110 = read_voxels8(table, pool, volume, x + 1, y + 1, z);
        c.v001 = read_voxels8(table, pool, volume, x, y, z + 1);
        c.v101 = read_voxels8(table, pool, volume, x + 1, y, z + 1);
        c.v011 = read_voxels8(table, pool, volume, x, y + 1, z + 1);
        c.v111 = read_voxels8(table, pool, volume, x + 1, y + 1, z + 1);
        return c;
    }
    const int8 slot = gather_int8(table, brick_of8(volume, x, y, z));
    const int8 at = max(slot, 0) * BRICK_VOXELS + offset_in_brick8(x, y, z);
    c.v000 = gather_int8(pool, at);
    c.v100 = gather_int8(pool, at + 1);
    c.v010 = gather_int8(pool, at + 8);
    c.v110 = gather_int8(pool, at + 9);
    c.v001 = gather_int8(pool, at + 64);
    c.v101 = gather_int8(pool, at + 65);
    c.v011 = gather_int8(pool, at + 72);
    c.v111 = gather_int8(pool, at + 73);
    /* An absent brick is unknown: one unknown corner makes the whole sample so. */
    c.v000 = select((int8)(0), c.v000, slot >= 0);
    return c;
}

typedef struct Sample8 {
    float8 tsdf;
    int8 known; /* -1 where all eight neighbours are known */
    Points8 gradient;
} Sample8;

/* Trilinear TSDF and its gradient (per voxel, not normalised) at points in voxel units. */
INLINE Sample8 sample_trilinear8(__global const int* table, __global const int* pool, const VolumeParams volume,
                                 const Points8 p_vox) {
    const float8 fx = floor(p_vox.x - 0.5f), fy = floor(p_vox.y - 0.5f), fz = floor(p_vox.z - 0.5f);
    const float8 ax = p_vox.x - 0.5f - fx, ay = p_vox.y - 0.5f - fy, az = p_vox.z - 0.5f - fz;
    const Cells8 v = read_cells8(table, pool, volume, convert_int8_rtz(fx), convert_int8_rtz(fy), convert_int8_rtz(fz));
    const float8 f000 = voxel_tsdf8(v.v000), f100 = voxel_tsdf8(v.v100), f010 = voxel_tsdf8(v.v010);
    const float8 f110 = voxel_tsdf8(v.v110), f001 = voxel_tsdf8(v.v001), f101 = voxel_tsdf8(v.v101);
    const float8 f011 = voxel_tsdf8(v.v011), f111 = voxel_tsdf8(v.v111);
    Sample8 s;
    s.known = (voxel_weight8(v.v000) > 0) & (voxel_weight8(v.v100) > 0) & (voxel_weight8(v.v010) > 0) &
              (voxel_weight8(v.v110) > 0) & (voxel_weight8(v.v001) > 0) & (voxel_weight8(v.v101) > 0) &
              (voxel_weight8(v.v011) > 0) & (voxel_weight8(v.v111) > 0);
    const float8 c00 = mix(f000, f100, ax), c10 = mix(f010, f110, ax), c01 = mix(f001, f101, ax), c11 = mix(f011, f111, ax);
    const float8 c0 = mix(c00, c10, ay), c1 = mix(c01, c11, ay);
    s.tsdf = mix(c0, c1, az);
    s.gradient.z = c1 - c0;
    s.gradient.y = mix(c10 - c00, c11 - c01, az);
    s.gradient.x = mix(mix(f100 - f000, f110 - f010, ay), mix(f101 - f001, f111 - f011, ay), az);
    return s;
}

#endif
