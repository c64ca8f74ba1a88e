/* Camera and frame maths on eight lanes along x. */
#ifndef TOUCHSTONE_DEVICE_MATH_H
#define TOUCHSTONE_DEVICE_MATH_H

/* Without the attribute PoCL calls: integration takes 9.0 instead of 5.7 ms. */
#define INLINE static inline __attribute__((always_inline))

typedef struct Points8 {
    float8 x, y, z;
} Points8;

INLINE float8 lanes8(void) { return (float8)(0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f); }

INLINE Points8 transform_points8(const Pose T, const Points8 p) {
    Points8 r;
    r.x = T.row_x.x * p.x + (T.row_x.y * p.y + (T.row_x.z * p.z + T.row_x.w));
    r.y = T.row_y.x * p.x + (T.row_y.y * p.y + (T.row_y.z * p.z + T.row_y.w));
    r.z = T.row_z.x * p.x + (T.row_z.y * p.y + (T.row_z.z * p.z + T.row_z.w));
    return r;
}

INLINE Points8 rotate_vectors8(const Pose T, const Points8 p) {
    Points8 r;
    r.x = T.row_x.x * p.x + (T.row_x.y * p.y + T.row_x.z * p.z);
    r.y = T.row_y.x * p.x + (T.row_y.y * p.y + T.row_y.z * p.z);
    r.z = T.row_z.x * p.x + (T.row_z.y * p.y + T.row_z.z * p.z);
    return r;
}

/* K^-1 [u, 1] for the eight pixels that start at (x, y): z = 1. */
INLINE Points8 pixel_rays8(const Intrinsics k, const int x, const int y) {
    Points8 r;
    r.x = (lanes8() + ((float)x - k.cx_px)) * (1.0f / k.fx_px);
    r.y = (float8)(((float)y - k.cy_px) / k.fy_px);
    r.z = (float8)(1.0f);
    return r;
}

/* v(u) = D(u) K^-1 [u, 1] */
INLINE Points8 back_project8(const Intrinsics k, const int x, const int y, const float8 depth_m) {
    Points8 r = pixel_rays8(k, x, y);
    r.x *= depth_m;
    r.y *= depth_m;
    r.z = depth_m;
    return r;
}

INLINE float8 dot8(const Points8 a, const Points8 b) { return a.x * b.x + (a.y * b.y + a.z * b.z); }

INLINE float sum8(const float8 v) {
    const float4 a = v.lo + v.hi;
    const float2 b = a.lo + a.hi;
    return b.x + b.y;
}

/* Where camera points are in a picture: between pixels (u, v) and the nearest pixel's column and row, 0 where none is inside. */
typedef struct Projection8 {
    float8 inverse_z, u, v;
    int8 column, row, inside;
} Projection8;

INLINE Projection8 project8(const Intrinsics k, const MapShape shape, const Points8 p_c) {
    const int8 ahead = p_c.z > 0.05f;
    Projection8 r;
    r.inverse_z = 1.0f / select((float8)(1.0f), p_c.z, ahead);
    r.u = p_c.x * r.inverse_z * k.fx_px + k.cx_px;
    r.v = p_c.y * r.inverse_z * k.fy_px + k.cy_px;
    const float8 u = r.u + 0.5f, v = r.v + 0.5f;
    r.inside = ahead & (u >= 0.0f) & (v >= 0.0f) & (u < (float)shape.width_px) & (v < (float)shape.height_px);
    r.column = convert_int8_rtz(select((float8)(0.0f), u, r.inside));
    r.row = convert_int8_rtz(select((float8)(0.0f), v, r.inside));
    return r;
}

/* The nearest pixel of each camera point as an index into a map, or -1 where it falls outside the picture. */
INLINE int8 project_to_index8(const Intrinsics k, const MapShape shape, const Points8 p_c) {
    const Projection8 p = project8(k, shape, p_c);
    return select((int8)(-1), p.row * shape.pitch_px + p.column, p.inside);
}

/* Values of a map at eight indices; 0 where the index is negative. */
INLINE float8 gather8(__global const float* map, const int8 index) {
    const int8 i = max(index, 0);
    const float8 values = (float8)(map[i.s0], map[i.s1], map[i.s2], map[i.s3], map[i.s4], map[i.s5], map[i.s6], map[i.s7]);
    return select((float8)(0.0f), values, index >= 0);
}

INLINE int8 gather_int8(__global const int* map, const int8 index) {
    const int8 i = max(index, 0);
    const int8 values = (int8)(map[i.s0], map[i.s1], map[i.s2], map[i.s3], map[i.s4], map[i.s5], map[i.s6], map[i.s7]);
    return select((int8)(-1), values, index >= 0);
}

/* Of a map that is whole ints long, on a little-endian device: a CPU gathers nothing smaller. Value 0 of the map where the index is
 * negative. */
INLINE uchar8 gather_uchar8(__global const uchar* map, const int8 index) {
    const int8 i = max(index, 0);
    const int8 four = gather_int8((__global const int*)map, i >> 2);
    return convert_uchar8((four >> ((i & 3) << 3)) & 0xff);
}

/* Axial noise of the sensor for a surface that faces it. */
INLINE float8 sigma_z8(const SensorNoise noise, const float8 depth_m) {
    const float8 from_offset = depth_m - noise.offset_m;
    return noise.constant_m + noise.quadratic * from_offset * from_offset;
}

#endif
