/* Listing 3 from the first hit on, for a view from anywhere: lighting, what a mesh hides, shadows and a mirror sphere by secondary
 * rays. Rays are in the global frame, in voxel units; eight pixels a work-item. */

#define MESH_SHADOW_BIAS_M 0.008f /* of a mesh on itself, and on what it stands on */

/* What a mesh leaves of the light: of its depths as the light sees it, the four around each point (metres, global frame). */
INLINE float8 mesh_share8(__global const float* shadow_m, const Intrinsics k, const MapShape shape, const Pose T_l_g,
                          const Points8 point_g_m) {
    const Points8 p = transform_points8(T_l_g, point_g_m);
    const int8 ahead = p.z > 0.05f;
    const float8 inverse_z = 1.0f / select((float8)(1.0f), p.z, ahead);
    const float8 u = p.x * inverse_z * k.fx_px + k.cx_px, v = p.y * inverse_z * k.fy_px + k.cy_px;
    const int8 inside = ahead & (u >= 0.0f) & (v >= 0.0f) & (u < (float)(shape.width_px - 1)) & (v < (float)(shape.height_px - 1));
    if (!any(inside)) return (float8)(1.0f);
    const float8 left = floor(select((float8)(0.0f), u, inside)), top = floor(select((float8)(0.0f), v, inside));
    const float8 a = select((float8)(0.0f), u, inside) - left, b = select((float8)(0.0f), v, inside) - top;
    float8 dark = (float8)(0.0f);
    for (int corner = 0; corner < 4; ++corner) {
        const int dx = corner & 1, dy = corner >> 1;
        const int8 at = (convert_int8_rtz(top) + dy) * shape.pitch_px + convert_int8_rtz(left) + dx;
        const float8 depth_m = gather8(shadow_m, select((int8)(-1), at, inside));
        const float8 near = (dx ? a : 1.0f - a) * (dy ? b : 1.0f - b);
        dark += select((float8)(0.0f), near, inside & (depth_m > 0.0f) & (depth_m < p.z - MESH_SHADOW_BIAS_M));
    }
    return 1.0f - dark;
}

/* What pixels show, seen directly or in the mirror. */
typedef struct Seen8 {
    Points8 point, normal, direction; /* of the ray that came to it */
    Colour8 colour;
    float8 depth_m;        /* of the primary ray's end */
    int8 hit, mesh, mirror; /* hit: there is a surface; mesh: it is the mesh's */
} Seen8;

/* Where a mesh is nearer than the surface the ray ends at it. */
INLINE void end_at_mesh8(__global const float* mesh_m, __global const float* mesh_normals_c, __global const uint* mesh_rgba,
                         const MapShape mesh_shape, const int step, const int x, const int y, Seen8* seen) {
    const int8 column = (convert_int8(lanes8()) + x) * step;
    const int8 inside = (column < mesh_shape.width_px) & (int8)(y * step < mesh_shape.height_px ? -1 : 0);
    const int8 at = select((int8)(-1), y * step * mesh_shape.pitch_px + column, inside);
    const float8 depth_m = gather8(mesh_m, at);  // L3:7 L3:8
    const int8 nearer = inside & (depth_m > 0.0f) & ((seen->depth_m <= 0.0f) | (depth_m < seen->depth_m));  // L3:19
    if (!any(nearer)) return;
    const int plane = mesh_shape.pitch_px * mesh_shape.rows_px;
    const int8 used = select((int8)(-1), at, nearer);
    const Points8 normal = {gather8(mesh_normals_c, used), gather8(mesh_normals_c + plane, used),
                            gather8(mesh_normals_c + 2 * plane, used)};
    seen->depth_m = select(seen->depth_m, depth_m, nearer);
    seen->normal = choose_points8(seen->normal, normal, nearer);
    seen->colour = choose_colour8(seen->colour, colour_of8(as_uint8(gather_int8((__global const int*)mesh_rgba, used))), nearer);
    seen->mesh = nearer;
    seen->hit |= nearer;
}

/* Where the sphere is nearest the ray goes on, mirrored, to what is to be seen in it. `camera`, `ray_g`: ray of depth 1. */
INLINE void follow_mirror8(__global const int* table, __global const int* pool, const VolumeParams volume,
                           const ViewLightingParams params, const Points8 camera, const Points8 ray_g, const float4 sphere_vox,
                           const int8 in_picture, Seen8* seen) {
    const Points8 from = {camera.x - sphere_vox.x, camera.y - sphere_vox.y, camera.z - sphere_vox.z};
    const float8 a = dot8(ray_g, ray_g), b = dot8(from, ray_g), c = dot8(from, from) - sphere_vox.w * sphere_vox.w;
    const float8 discriminant = b * b - a * c;
    const float8 t = (-b - sqrt(fmax(discriminant, 0.0f))) / a, depth_m = t * volume.voxel_m;
    const int8 nearer = (seen->depth_m <= 0.0f) | (depth_m < seen->depth_m);
    seen->mirror = in_picture & (discriminant > 0.0f) & (t > 0.0f) & nearer;
    if (!any(seen->mirror)) return;
    const Points8 normal = scaled8(along8(from, ray_g, t), (float8)(1.0f / sphere_vox.w));
    const Points8 reflected = along8(seen->direction, normal, -2.0f * dot8(seen->direction, normal));
    const Ray8 ray = make_ray8(along8(camera, ray_g, t), reflected, params);
    const Hit8 hit = first_hit8(table, pool, volume, &ray, seen->mirror);  // L3:18
    seen->depth_m = select(seen->depth_m, depth_m, seen->mirror);
    seen->point = choose_points8(seen->point, along8(ray.origin, ray.direction, hit.t), seen->mirror);
    seen->normal = choose_points8(seen->normal, hit.normal, seen->mirror);
    seen->direction = choose_points8(seen->direction, reflected, seen->mirror);
    seen->hit = select(seen->hit, hit.found, seen->mirror);
    seen->mesh &= ~seen->mirror;
}

/* The volume's colours around p, those that there are weighed by nearness; else the one for all surfaces. */
INLINE Colour8 surface_colour8(__global const int* color_table, __global const uint* colors, const VolumeParams volume,
                               const ViewLightingParams params, const Points8 p, const int8 wanted) {
    const Colour8 fixed = one_colour8(params.surface);
    if (!params.has_colors || !any(wanted)) return fixed;
    const float last = (float)volume.size_vox - 1.5f;
    const float8 px = fmax(fmin(p.x - 0.5f, last), 0.0f), py = fmax(fmin(p.y - 0.5f, last), 0.0f);
    const float8 pz = fmax(fmin(p.z - 0.5f, last), 0.0f);
    const int8 x = convert_int8_rtz(px), y = convert_int8_rtz(py), z = convert_int8_rtz(pz);
    const float8 ax = px - convert_float8(x), ay = py - convert_float8(y), az = pz - convert_float8(z);
    Colour8 sum = {(float8)(0.0f), (float8)(0.0f), (float8)(0.0f)};
    float8 weights = (float8)(1e-6f);
    for (int corner = 0; corner < 8; ++corner) {
        const int dx = corner & 1, dy = (corner >> 1) & 1, dz = corner >> 2;
        const uint8 rgbw = as_uint8(read_voxels8(color_table, (__global const int*)colors, volume, x + dx, y + dy, z + dz));
        const float8 near = (dx ? ax : 1.0f - ax) * (dy ? ay : 1.0f - ay) * (dz ? az : 1.0f - az);
        const float8 weight = select((float8)(0.0f), near, (rgbw >> (uint8)(24)) != (uint8)(0));
        const Colour8 c = colour_of8(rgbw);
        sum.r += c.r * weight, sum.g += c.g * weight, sum.b += c.b * weight;
        weights += weight;
    }
    const Colour8 mean = {sum.r / weights, sum.g / weights, sum.b / weights};
    return choose_colour8(fixed, mean, weights > 1e-3f);
}

/* Share of the light that arrives, past the volume's surfaces where `by_surfaces` is set, and past the sphere: the edge of a shadow
 * is a voxel wide. The ray begins where it has left its own surface: on its way, not beside it, so that shadows do not shift. */
INLINE float8 light_share8(__global const int* table, __global const int* pool, const VolumeParams volume,
                           const ViewLightingParams params, const Points8 to_light, const float4 sphere_vox, const Seen8* seen,
                           const float8 cos_light, const int8 by_surfaces) {
    const int8 wanted = seen->hit & (cos_light > 0.0f);
    if (!any(wanted)) return (float8)(0.0f);
    const Points8 light = normalized8(to_light);
    const float8 start = params.start_vox / fmax(cos_light, params.grazing_cos);
    const float8 length = sqrt(dot8(to_light, to_light)) - start;
    const Ray8 ray = make_ray8(along8(seen->point, light, start), light, params);
    const float8 of_surfaces = clearance8(table, pool, volume, &ray, fmin(length, ray.leave), wanted & by_surfaces);  // L3:21
    const float8 of_sphere = sphere_clearance8(ray.origin, light, fmax(length, 0.0f), sphere_vox);
    const float8 fade = smoothstep(0.0f, params.grazing_cos, cos_light);
    return select((float8)(0.0f), fade * clamp(0.5f + fmin(of_surfaces, of_sphere), 0.0f, 1.0f), wanted);
}

INLINE Colour8 sky8(const ViewLightingParams params, const Points8 direction) {
    const float8 up = direction.x * params.up_g.x + direction.y * params.up_g.y + direction.z * params.up_g.z;
    const float8 share = clamp(0.5f + 0.5f * up, 0.0f, 1.0f);
    const Colour8 c = {params.sky_low.x + (params.sky_high.x - params.sky_low.x) * share,
                       params.sky_low.y + (params.sky_high.y - params.sky_low.y) * share,
                       params.sky_low.z + (params.sky_high.z - params.sky_low.z) * share};
    return c;
}

/* ViewStyle of pipeline/scene_wish.hpp. Over the camera's picture: what is virtual, and its shadows as black with alpha. */
#define STYLE_NORMALS 1
#define STYLE_COLOURS 2
#define STYLE_OVER_CAMERA 4

/* As show_normals of shading.cl: red to the right, green up, blue towards the camera. */
INLINE Colour8 colour_of_normal8(const Points8 normal_c) {
    const Colour8 c = {0.5f + 0.5f * normal_c.x, 0.5f - 0.5f * normal_c.y, 0.5f - 0.5f * normal_c.z};
    return c;
}

__kernel void light_view(__global const int* table, __global const int* pool, __global const int* color_table,
                         __global const uint* colors, __global const float* surface_m, __global const float* surface_normals_c,
                         __global const float* mesh_m, __global const float* mesh_normals_c, __global const uint* mesh_rgba,
                         __global uint* rgba, __global float* depth_m, const VolumeParams volume, const Intrinsics k,
                         const MapShape shape, const MapShape mesh_shape, const Pose T_g_c, const ViewLightingParams params,
                         const int style, __global const float* shadow_m, const Intrinsics shadow_k, const MapShape shadow_shape,
                         const Pose T_l_g) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1), plane = shape.pitch_px * shape.rows_px;
    const int at = y * shape.pitch_px + x;
    const float to_vox = 1.0f / volume.voxel_m;
    const float4 light_vox = params.light_g_m * to_vox, sphere_vox = params.sphere_g_m * to_vox;
    const int8 in_picture = (lanes8() + (float)x < (float)shape.width_px) & (int8)(y < shape.height_px ? -1 : 0);
    const Points8 ray_g = rotate_vectors8(T_g_c, pixel_rays8(k, x, y));
    const Points8 camera = {(float8)(T_g_c.row_x.w * to_vox), (float8)(T_g_c.row_y.w * to_vox), (float8)(T_g_c.row_z.w * to_vox)};
    Seen8 seen;
    seen.depth_m = vload8(0, surface_m + at);
    seen.hit = seen.depth_m > 0.0f;
    seen.mesh = seen.mirror = (int8)(0);
    seen.normal = load_points8(surface_normals_c + at, plane);
    seen.colour.r = seen.colour.g = seen.colour.b = (float8)(0.0f);
    if (params.mesh_step) end_at_mesh8(mesh_m, mesh_normals_c, mesh_rgba, mesh_shape, params.mesh_step, x, y, &seen);
    const Points8 normal_c = seen.normal;
    seen.normal = rotate_vectors8(T_g_c, normal_c);
    seen.point = along8(camera, ray_g, seen.depth_m * to_vox);
    seen.direction = normalized8(ray_g);
    if (sphere_vox.w > 0.0f) follow_mirror8(table, pool, volume, params, camera, ray_g, sphere_vox, in_picture, &seen);
    const Colour8 own = surface_colour8(color_table, colors, volume, params, seen.point, seen.hit & ~seen.mesh);
    const Colour8 base = choose_colour8(own, seen.colour, seen.mesh);  // L3:20

    const Points8 to_light = {light_vox.x - seen.point.x, light_vox.y - seen.point.y, light_vox.z - seen.point.z};
    const Points8 light = normalized8(to_light);
    const float8 cos_light = dot8(seen.normal, light);
    const int is_unlit = style == STYLE_NORMALS || (style == STYLE_COLOURS && params.has_colors);
    /* The camera's own picture has the shadows of what is real in it. */
    const int8 is_virtual = seen.mesh | seen.mirror, over_camera = (int8)(style == STYLE_OVER_CAMERA ? -1 : 0);
    float8 share = (float8)(0.0f);
    if (!is_unlit)
        share = light_share8(table, pool, volume, params, to_light, sphere_vox, &seen, cos_light, is_virtual | ~over_camera);
    if (shadow_k.fx_px > 0.0f && !is_unlit)
        share *= mesh_share8(shadow_m, shadow_k, shadow_shape, T_l_g, scaled8(seen.point, (float8)(volume.voxel_m)));
    const float8 level = params.ambient + params.diffuse * fmax(cos_light, 0.0f) * share;
    float8 shine = fmax(dot8(along8(light, seen.normal, -2.0f * cos_light), seen.direction), 0.0f);
    shine *= shine, shine *= shine, shine *= shine, shine *= shine;
    shine *= params.surface.w * share;
    Colour8 lit = {base.r * level + shine, base.g * level + shine, base.b * level + shine};
    if (is_unlit) lit = style == STYLE_NORMALS ? colour_of_normal8(normal_c) : base;
    const Colour8 beyond = choose_colour8(one_colour8(params.unknown), sky8(params, seen.direction), seen.mirror);
    const Colour8 shown = choose_colour8(beyond, lit, seen.hit);
    const float8 kept = select((float8)(1.0f), (float8)(params.mirror), seen.mirror);
    const Colour8 dimmed = {shown.r * kept, shown.g * kept, shown.b * kept};
    uint8 shown_rgba = pack_rgba8(dimmed, (uint8)(255u));
    if (style == STYLE_OVER_CAMERA) {
        const float8 unshaded = params.ambient + params.diffuse * fmax(cos_light, 0.0f) * smoothstep(0.0f, params.grazing_cos, cos_light);
        const float8 darkness = select((float8)(0.0f), clamp(1.0f - level / unshaded, 0.0f, 1.0f), seen.hit);
        shown_rgba = select(convert_uint8(convert_int8_rte(255.0f * darkness)) << (uint8)(24), shown_rgba, is_virtual);
    }
    vstore8(shown_rgba, 0, rgba + at);
    vstore8(seen.depth_m, 0, depth_m + at);
}
