/* What the product is measured against: every voxel of one dense array, every ray from the front, as the paper writes it.
 * Voxel: low 16 bits signed TSDF * 32766, high 16 bits weight. The cube's corner is the global origin. */

INLINE float8 tsdf8(const int8 voxel) { return convert_float8((voxel << 16) >> 16) * (1.0f / 32766.0f); }

/* Listing 2 on eight voxels along x; global size (n / 8, n, n). Signed distance along the optical axis, behind the surface by
 * more than mu_m: left alone. */
__kernel void dense_integrate(__global int* voxels, const int n, const float voxel_m, __global const float* depth_m,
                              const MapShape shape, const Intrinsics k, const Pose T_c_g, const float mu_m, const int most_weight) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1), z = (int)get_global_id(2);
    Points8 centre;
    centre.x = (lanes8() + ((float)x + 0.5f)) * voxel_m;
    centre.y = (float8)(((float)y + 0.5f) * voxel_m);
    centre.z = (float8)(((float)z + 0.5f) * voxel_m);
    const Points8 p = transform_points8(T_c_g, centre);
    const int8 pixel = project_to_index8(k, shape, p);
    if (!any(pixel >= 0)) return;
    const float8 depth = gather8(depth_m, pixel), sdf = depth - p.z;
    const int8 updated = (depth > 0.0f) & (sdf > -mu_m);
    if (!any(updated)) return;
    __global int* at = voxels + ((size_t)z * n + y) * n + x;
    const int8 old = vload8(0, at), weight = old >> 16;
    const float8 w = convert_float8(weight);
    const float8 mean = (tsdf8(old) * w + fmin(1.0f, sdf / mu_m)) / (w + 1.0f);
    const int8 voxel = (min(weight + 1, most_weight) << 16) | (convert_int8_rte(mean * 32766.0f) & 0xffff);
    vstore8(select(old, voxel, updated), 0, at);
}

INLINE float tsdf_or_free(const int voxel) {
    return (voxel >> 16) > 0 ? (float)((voxel << 16) >> 16) * (1.0f / 32766.0f) : 1.0f;
}

/* TSDF at a point in voxels; 1 outside and where nothing is known. */
INLINE float nearest_tsdf(__global const int* voxels, const int n, const float3 p) {
    const int x = (int)floor(p.x), y = (int)floor(p.y), z = (int)floor(p.z);
    if (((uint)x >= (uint)n) | ((uint)y >= (uint)n) | ((uint)z >= (uint)n)) return 1.0f;
    return tsdf_or_free(voxels[(z * n + y) * n + x]);
}

INLINE float trilinear_tsdf(__global const int* voxels, const int n, const float3 p) {
    const float3 q = p - 0.5f, f = floor(q), a = q - f;
    const int x = (int)f.x, y = (int)f.y, z = (int)f.z;
    const uint last = (uint)(n - 1);
    if (((uint)x >= last) | ((uint)y >= last) | ((uint)z >= last)) return 1.0f;
    __global const int* v = voxels + (z * n + y) * n + x;
    float c[2];
    for (int i = 0; i < 2; ++i, v += n * n)
        c[i] = mix(mix(tsdf_or_free(v[0]), tsdf_or_free(v[1]), a.x), mix(tsdf_or_free(v[n]), tsdf_or_free(v[n + 1]), a.x), a.y);
    return mix(c[0], c[1], a.z);
}

/* Where a ray leaves the cube of n voxels, in units of the ray. */
INLINE float exit_of(const float3 eye, const float3 ray, const float n) {
    const float3 ahead = select((float3)(0.0f), (float3)(n), ray > 0.0f);
    const float3 t = (ahead - eye) / select(ray, (float3)(1e-9f), fabs(ray) < 1e-9f);
    return fmin(t.x, fmin(t.y, t.z));
}

/* Listing 3, one pixel a work-item, from start_m to the end of the cube in steps of max(voxel, 0.8 tsdf mu), which is less work
 * than the paper's steps of one voxel; the crossing between two trilinear values, the normal from their gradient. Depth 0 where
 * nothing is hit. Three planes of normals, in the global frame. */
__kernel void dense_raycast(__global const int* voxels, const int n, const float voxel_m, __global float* depth_m,
                            __global float* normals_g, const MapShape shape, const Intrinsics k, const Pose T_g_c,
                            const float mu_m, const float start_m) {
    const int x = (int)get_global_id(0), y = (int)get_global_id(1), at = y * shape.pitch_px + x;
    const float3 ray_c = (float3)(((float)x - k.cx_px) / k.fx_px, ((float)y - k.cy_px) / k.fy_px, 1.0f);
    const float3 ray = (float3)(dot((float3)(T_g_c.row_x.x, T_g_c.row_x.y, T_g_c.row_x.z), ray_c),
                                dot((float3)(T_g_c.row_y.x, T_g_c.row_y.y, T_g_c.row_y.z), ray_c),
                                dot((float3)(T_g_c.row_z.x, T_g_c.row_z.y, T_g_c.row_z.z), ray_c)) / voxel_m;
    const float3 eye = (float3)(T_g_c.row_x.w, T_g_c.row_y.w, T_g_c.row_z.w) / voxel_m;
    const float end_m = exit_of(eye, ray, (float)n);
    float hit_m = 0.0f, before_m = start_m, last = 1.0f;
    for (float t = start_m; t < end_m;) {
        const float value = nearest_tsdf(voxels, n, eye + t * ray);
        if (value < 0.0f && last > 0.0f) {
            const float near = trilinear_tsdf(voxels, n, eye + before_m * ray), far = trilinear_tsdf(voxels, n, eye + t * ray);
            hit_m = near > far ? clamp(before_m + (t - before_m) * near / (near - far), before_m - voxel_m, t + voxel_m) : t;
            break;
        }
        if (value < 0.0f) break;
        last = value;
        before_m = t;
        t += fmax(voxel_m, 0.8f * mu_m * value);
    }
    float3 normal = (float3)(0.0f);
    if (hit_m > 0.0f) {
        const float3 p = eye + hit_m * ray;
        normal.x = trilinear_tsdf(voxels, n, p + (float3)(1.0f, 0.0f, 0.0f)) - trilinear_tsdf(voxels, n, p - (float3)(1.0f, 0.0f, 0.0f));
        normal.y = trilinear_tsdf(voxels, n, p + (float3)(0.0f, 1.0f, 0.0f)) - trilinear_tsdf(voxels, n, p - (float3)(0.0f, 1.0f, 0.0f));
        normal.z = trilinear_tsdf(voxels, n, p + (float3)(0.0f, 0.0f, 1.0f)) - trilinear_tsdf(voxels, n, p - (float3)(0.0f, 0.0f, 1.0f));
        normal *= rsqrt(fmax(dot(normal, normal), 1e-12f));
    }
    const int plane = shape.pitch_px * shape.rows_px;
    depth_m[at] = hit_m;
    normals_g[at] = normal.x;
    normals_g[plane + at] = normal.y;
    normals_g[2 * plane + at] = normal.z;
}
