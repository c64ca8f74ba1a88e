/* Camera and frame maths on LANES lanes along x, 8 or 16: read once for each, names end with their number. */

/* Names are joined before they are expanded: PoCL's `dot` is a macro. */
#if LANES == 16
#define LANE_NAME(name) name##16
#define TO_INTS convert_int16_rtz
#define EACH_LANE(of) \
    of(0), of(1), of(2), of(3), of(4), of(5), of(6), of(7), of(8), of(9), of(a), of(b), of(c), of(d), of(e), of(f)
#else
#define LANE_NAME(name) name##8
#define TO_INTS convert_int8_rtz
#define EACH_LANE(of) of(0), of(1), of(2), of(3), of(4), of(5), of(6), of(7)
#endif
#define FLOATS LANE_NAME(float)
#define INTS LANE_NAME(int)
#define UCHARS LANE_NAME(uchar)
#define POINTS LANE_NAME(Points)
#define PROJECTION LANE_NAME(Projection)
#define NUMBER_OF_LANE(n) (float)0x##n
#define MAP_AT_LANE(n) map[i.s##n]

typedef struct POINTS {
    FLOATS x, y, z;
} POINTS;

/* From three planes, one after the other. */
INLINE POINTS LANE_NAME(load_points)(__global const float* x, const int plane) {
    const POINTS p = {LANE_NAME(vload)(0, x), LANE_NAME(vload)(0, x + plane), LANE_NAME(vload)(0, x + 2 * plane)};
    return p;
}

INLINE FLOATS LANE_NAME(lanes)(void) { return (FLOATS)(EACH_LANE(NUMBER_OF_LANE)); }

INLINE POINTS LANE_NAME(transform_points)(const Pose T, const POINTS p) {
    POINTS r;
    r.x = T.row_x.x * p.x + (T.row_x.y * p.y + (T.row_x.z * p.z + T.row_x.w));
    r.y = T.row_y.x * p.x + (T.row_y.y * p.y + (T.row_y.z * p.z + T.row_y.w));
    r.z = T.row_z.x * p.x + (T.row_z.y * p.y + (T.row_z.z * p.z + T.row_z.w));
    return r;
}

INLINE POINTS LANE_NAME(rotate_vectors)(const Pose T, const POINTS p) {
    POINTS r;
    r.x = T.row_x.x * p.x + (T.row_x.y * p.y + T.row_x.z * p.z);
    r.y = T.row_y.x * p.x + (T.row_y.y * p.y + T.row_y.z * p.z);
    r.z = T.row_z.x * p.x + (T.row_z.y * p.y + T.row_z.z * p.z);
    return r;
}

/* K^-1 [u, 1] for the pixels that start at (x, y): z = 1. */
INLINE POINTS LANE_NAME(pixel_rays)(const Intrinsics k, const int x, const int y) {
    POINTS r;
    r.x = (LANE_NAME(lanes)() + ((float)x - k.cx_px)) * (1.0f / k.fx_px);
    r.y = (FLOATS)(((float)y - k.cy_px) / k.fy_px);
    r.z = (FLOATS)(1.0f);
    return r;
}

/* v(u) = D(u) K^-1 [u, 1] */
INLINE POINTS LANE_NAME(back_project)(const Intrinsics k, const int x, const int y, const FLOATS depth_m) {
    POINTS r = LANE_NAME(pixel_rays)(k, x, y);
    r.x *= depth_m;
    r.y *= depth_m;
    r.z = depth_m;
    return r;
}

INLINE FLOATS LANE_NAME(dot)(const POINTS a, const POINTS b) { return a.x * b.x + (a.y * b.y + a.z * b.z); }

INLINE float LANE_NAME(sum)(const FLOATS v) {
#if LANES == 16
    return sum8(v.lo + v.hi);
#else
    const float4 a = v.lo + v.hi;
    const float2 b = a.lo + a.hi;
    return b.x + b.y;
#endif
}

/* Where camera points are in a picture: between pixels (u, v) and the nearest pixel's column and row, 0 where none is inside. */
typedef struct PROJECTION {
    FLOATS inverse_z, u, v;
    INTS column, row, inside;
} PROJECTION;

INLINE PROJECTION LANE_NAME(project)(const Intrinsics k, const MapShape shape, const POINTS p_c) {
    const INTS ahead = p_c.z > 0.05f;
    PROJECTION r;
    r.inverse_z = 1.0f / select((FLOATS)(1.0f), p_c.z, ahead);
    r.u = p_c.x * r.inverse_z * k.fx_px + k.cx_px;
    r.v = p_c.y * r.inverse_z * k.fy_px + k.cy_px;
    const FLOATS u = r.u + 0.5f, v = r.v + 0.5f;
    r.inside = ahead & (u >= 0.0f) & (v >= 0.0f) & (u < (float)shape.width_px) & (v < (float)shape.height_px);
    r.column = TO_INTS(select((FLOATS)(0.0f), u, r.inside));
    r.row = TO_INTS(select((FLOATS)(0.0f), v, r.inside));
    return r;
}

/* The nearest pixel of each camera point as an index into a map, or -1 where it falls outside the picture. */
INLINE INTS LANE_NAME(project_to_index)(const Intrinsics k, const MapShape shape, const POINTS p_c) {
    const PROJECTION p = LANE_NAME(project)(k, shape, p_c);
    return select((INTS)(-1), p.row * shape.pitch_px + p.column, p.inside);
}

/* Values of a map at these indices; 0 where the index is negative. */
INLINE FLOATS LANE_NAME(gather)(__global const float* map, const INTS index) {
    const INTS i = max(index, 0);
    const FLOATS values = (FLOATS)(EACH_LANE(MAP_AT_LANE));
    return select((FLOATS)(0.0f), values, index >= 0);
}

INLINE INTS LANE_NAME(gather_int)(__global const int* map, const INTS index) {
    const INTS i = max(index, 0);
    const INTS values = (INTS)(EACH_LANE(MAP_AT_LANE));
    return select((INTS)(-1), values, index >= 0);
}

/* Of a map that is whole ints long, on a little-endian device: a CPU gathers nothing smaller. Value 0 of the map where the index is
 * negative. */
INLINE UCHARS LANE_NAME(gather_uchar)(__global const uchar* map, const INTS index) {
    const INTS i = max(index, 0);
    const INTS four = LANE_NAME(gather_int)((__global const int*)map, i >> 2);
    return LANE_NAME(convert_uchar)((four >> ((i & 3) << 3)) & 0xff);
}

/* Axial noise of the sensor for a surface that faces it. */
INLINE FLOATS LANE_NAME(sigma_z)(const SensorNoise noise, const FLOATS depth_m) {
    const FLOATS from_offset = depth_m - noise.offset_m;
    return noise.constant_m + noise.quadratic * from_offset * from_offset;
}

#undef LANE_NAME
#undef FLOATS
#undef INTS
#undef UCHARS
#undef POINTS
#undef PROJECTION
#undef TO_INTS
#undef NUMBER_OF_LANE
#undef MAP_AT_LANE
#undef EACH_LANE
#undef LANES
