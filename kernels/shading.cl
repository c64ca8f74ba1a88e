/* The table as the camera sees it (Fig 12c without meshes, Fig 14f): the background's raycast shaded, the foreground's over it
 * in another colour. Eight pixels a work-item; RGBA, alpha 0 on the foreground. */

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

/* Alpha 0 on the foreground. */
INLINE uint8 pack_table8(const Colour8 colour, const int8 moving) {
    return pack_rgba8(colour, select((uint8)(255u), (uint8)(0u), as_uint8(moving)));
}

/* A normal that is missing faces the camera. */
INLINE Points8 load_facing8(__global const float* normals, const MapShape shape, const int at) {
    const Points8 n = load_points8(normals + at, shape.pitch_px * shape.rows_px);
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
    const Points8 n = load_points8(background_normals_c + at, shape.pitch_px * shape.rows_px);
    Colour8 colour = phong8(n, ray_c, params.background, params.light_c);  // L3:17
    const Colour8 unknown = one_colour8(params.unknown);
    colour = choose_colour8(unknown, colour, depth_m > 0.0f);
    if (any(moving)) {
        const Points8 shown = load_facing8(foreground_normals_c, shape, at);
        colour = choose_colour8(colour, phong8(shown, ray_c, params.foreground, params.light_c), moving);
    }
    vstore8(pack_table8(colour, moving), 0, rgba + at);
}

/* The normals of background and foreground as colours (Fig 15): red to the right, green up, blue towards the camera. */
__kernel void show_normals(__global const float* background_m, __global const float* background_normals_c,
                           __global const float* foreground_normals_c, __global const uchar* foreground,
                           __global uint* rgba, const MapShape shape, const Intrinsics k, const ShadingParams params) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1), at = y * shape.pitch_px + x;
    const int8 moving = convert_int8(vload8(0, foreground + at)) != 0;
    const int8 known = (vload8(0, background_m + at) > 0.0f) | moving;
    const Points8 a = load_points8(background_normals_c + at, shape.pitch_px * shape.rows_px), b = load_facing8(foreground_normals_c, shape, at);
    const Colour8 of_normal = {0.5f + 0.5f * select(a.x, b.x, moving), 0.5f - 0.5f * select(a.y, b.y, moving),
                               0.5f - 0.5f * select(a.z, b.z, moving)};
    const Colour8 unknown = one_colour8(params.unknown);
    vstore8(pack_table8(choose_colour8(unknown, of_normal, known), moving), 0, rgba + at);
}
