/* The table as the camera sees it (Fig 12c without meshes, Fig 14f): the background's raycast shaded, the foreground's over it
 * in another colour. Eight pixels a work-item; RGBA, alpha 0 on the foreground. */

typedef struct Colour8 {
    float8 r, g, b;
} Colour8;

INLINE Points8 load_normals8(__global const float* normals, const MapShape shape, const int at) {
    const int plane = shape.pitch_px * shape.rows_px;
    const Points8 n = {vload8(0, normals + at), vload8(0, normals + plane + at), vload8(0, normals + 2 * plane + at)};
    return n;
}

/* Phong: ambient, diffuse and specular terms for a light that stands still in the camera frame. */
INLINE Colour8 phong8(const Points8 n, const Points8 ray_c, const float4 base, const float4 light) {
    const float8 diffuse = fmax(-(n.x * light.x + n.y * light.y + n.z * light.z), 0.0f);
    const float8 facing = fmax(-dot8(n, ray_c) * rsqrt(dot8(ray_c, ray_c)), 0.0f);
    float8 shine = facing * diffuse;
    shine *= shine, shine *= shine, shine *= shine;
    const float8 level = 0.30f + 0.45f * diffuse + 0.25f * facing;
    const Colour8 c = {base.x * level + base.w * shine, base.y * level + base.w * shine, base.z * level + base.w * shine};
    return c;
}

INLINE Colour8 choose8(const Colour8 otherwise, const Colour8 where_set, const int8 mask) {
    const Colour8 c = {select(otherwise.r, where_set.r, mask), select(otherwise.g, where_set.g, mask),
                       select(otherwise.b, where_set.b, mask)};
    return c;
}

INLINE uint8 to_byte8(const float8 value) { return convert_uint8_rte(clamp(value, 0.0f, 1.0f) * 255.0f); }

/* Alpha 0 on the foreground. */
INLINE uint8 pack_rgba8(const Colour8 colour, const int8 moving) {
    const uint8 alpha = select((uint8)(255u), (uint8)(0u), as_uint8(moving));
    return to_byte8(colour.r) | (to_byte8(colour.g) << 8) | (to_byte8(colour.b) << 16) | (alpha << 24);
}

/* A normal that is missing faces the camera. */
INLINE Points8 load_facing8(__global const float* normals, const MapShape shape, const int at) {
    const Points8 n = load_normals8(normals, shape, at);
    const int8 has_normal = dot8(n, n) > 0.0f;
    const Points8 shown = {select((float8)(0.0f), n.x, has_normal), select((float8)(0.0f), n.y, has_normal),
                           select((float8)(-1.0f), n.z, has_normal)};
    return shown;
}

__kernel void shade_view(__global const float* background_m, __global const float* background_normals_c,
                         __global const float* foreground_normals_c, __global const uchar* foreground,
                         __global uint* rgba, const MapShape shape, const Intrinsics k, const ShadingParams params) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1), at = y * shape.pitch_px + x;
    const Points8 ray_c = pixel_rays8(k, x, y);
    const float8 depth_m = vload8(0, background_m + at);
    const int8 moving = convert_int8(vload8(0, foreground + at)) != 0;
    const Points8 n = load_normals8(background_normals_c, shape, at);
    Colour8 colour = phong8(n, ray_c, params.background, params.light_c);  // L3:17
    const Colour8 unknown = {(float8)(params.unknown.x), (float8)(params.unknown.y), (float8)(params.unknown.z)};
    colour = choose8(unknown, colour, depth_m > 0.0f);
    if (any(moving)) {
        const Points8 shown = load_facing8(foreground_normals_c, shape, at);
        colour = choose8(colour, phong8(shown, ray_c, params.foreground, params.light_c), moving);
    }
    vstore8(pack_rgba8(colour, moving), 0, rgba + at);
}

/* The normals of background and foreground as colours (Fig 15): red to the right, green up, blue towards the camera. */
__kernel void show_normals(__global const float* background_m, __global const float* background_normals_c,
                           __global const float* foreground_normals_c, __global const uchar* foreground,
                           __global uint* rgba, const MapShape shape, const Intrinsics k, const ShadingParams params) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1), at = y * shape.pitch_px + x;
    const int8 moving = convert_int8(vload8(0, foreground + at)) != 0;
    const int8 known = (vload8(0, background_m + at) > 0.0f) | moving;
    const Points8 a = load_normals8(background_normals_c, shape, at), b = load_facing8(foreground_normals_c, shape, at);
    const Colour8 of_normal = {0.5f + 0.5f * select(a.x, b.x, moving), 0.5f - 0.5f * select(a.y, b.y, moving),
                               0.5f - 0.5f * select(a.z, b.z, moving)};
    const Colour8 unknown = {(float8)(params.unknown.x), (float8)(params.unknown.y), (float8)(params.unknown.z)};
    vstore8(pack_rgba8(choose8(unknown, of_normal, known), moving), 0, rgba + at);
}
