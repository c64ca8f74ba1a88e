/* Listing 1: projective data association, live picture against the prediction of the model, with the reason per pixel
 * where there is no counterpart: the outlier map of Fig 14b. Live frame c, prediction frame p; both points are compared
 * in p, so the model's vertex needs no transform. The distance test is in 1/z, the sensor's own unit. */

/* Variance of 1/z times z^4, of a surface seen at the angle theta; 2 tan^2 stands for (theta / (pi/2 - theta))^2. */
INLINE float8 variance_in_depth8(const AssociationParams params, const float8 z, const float8 grazing_m) {
    const float8 sigma_m = sigma_z8(params.noise, z) + grazing_m, step_m = params.quantisation_per_m * z * z;
    return sigma_m * sigma_m + step_m * step_m;
}

INLINE float8 grazing_noise8(const AssociationParams params, const float8 z, const float8 cos_theta) {
    const float8 cos2 = fmax(cos_theta * cos_theta, 0.01f);
    return params.noise.grazing * rsqrt(z) * 2.0f * (1.0f - cos2) / cos2;
}

INLINE Points8 load_or_gather_points8(__global const float* planes, const int at, const int plane, const int8 pixel,
                                      const int aligned) {
    if (aligned) return load_points8(planes + at, plane);
    const Points8 p = {gather8(planes, pixel), gather8(planes + plane, pixel), gather8(planes + 2 * plane, pixel)};
    return p;
}

/* fallback_m is used where the prediction has no surface; 0 there: nothing is known. aligned: T_p_c is the identity. */
__kernel void associate(__global const float* live_m, __global const float* live_normals_c,
                        __global const float* model_m, __global const float* model_normals_p,
                        __global const float* fallback_m, __global uchar* codes, const MapShape shape,
                        const Intrinsics k, const Pose T_p_c, const int aligned, const AssociationParams params) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1), at = y * shape.pitch_px + x;  // L1:1
    const int plane = shape.pitch_px * shape.rows_px;
    const float8 live = vload8(0, live_m + at);
    const int8 measured = live > 0.0f;  // L1:2
    if (!any(measured)) {
        vstore8((uchar8)(ASSOCIATION_NO_LIVE_DEPTH), 0, codes + at);
        return;
    }
    Points8 v = back_project8(k, x, y, live);
    int8 pixel = convert_int8(lanes8()) + at;
    if (!aligned) {
        v = transform_points8(T_p_c, v);             // L1:3
        pixel = project_to_index8(k, shape, v);      // L1:4
    }
    const float8 predicted = aligned ? vload8(0, model_m + at) : gather8(model_m, pixel);  // L1:6
    float8 model = predicted;
    if (any(predicted <= 0.0f)) {
        const float8 fallback = aligned ? vload8(0, fallback_m + at) : gather8(fallback_m, pixel);
        model = select(fallback, predicted, predicted > 0.0f);
    }
    const int8 known = measured & (v.z > 0.0f) & (model > 0.0f);  // L1:5
    const float8 z = select((float8)(1.0f), v.z, known);
    // The difference of 1/z times z^2: one division.
    const float8 nearer = (model - z) * (z / select((float8)(1.0f), model, known)), square = nearer * nearer;
    const float high = params.sigmas_high * params.sigmas_high, low = params.sigmas_low * params.sigmas_low;
    float8 variance = variance_in_depth8(params, z, (float8)(0.0f));
    Points8 n = {(float8)(0.0f), (float8)(0.0f), (float8)(0.0f)};
    int8 has_normal = (int8)(0);
    // A slanted surface only makes it larger: most pixels need no normal.
    if (any(known & (square > low * variance)) || params.min_normal_cos > -1.0f) {
        n = load_or_gather_points8(model_normals_p, at, plane, pixel, aligned);  // L1:7
        has_normal = known & (dot8(n, n) > 0.5f);
        const float8 cos_theta = select((float8)(1.0f), dot8(n, v) * rsqrt(dot8(v, v)), has_normal);
        variance = variance_in_depth8(params, z, grazing_noise8(params, z, cos_theta));
    }
    int8 code = select((int8)(ASSOCIATION_NO_MODEL), (int8)(ASSOCIATION_INLIER), known);  // L1:9
    code = select(code, (int8)(ASSOCIATION_NO_LIVE_DEPTH), ~measured);
    if (params.min_normal_cos > -1.0f) {
        Points8 n_live = load_points8(live_normals_c + at, plane);
        if (!aligned) n_live = rotate_vectors8(T_p_c, n_live);
        // "Within a threshold" of the angle: no abs(), which would let a back match a front.
        const int8 differs = has_normal & (dot8(n_live, n_live) > 0.5f) & (dot8(n, n_live) < params.min_normal_cos);
        code = select(code, (int8)(ASSOCIATION_NORMAL_DIFFERS), known & differs);
    }
    code = select(code, (int8)(ASSOCIATION_SLIGHTLY_IN_FRONT), known & (nearer > 0.0f) & (square > low * variance));
    code = select(code, (int8)(ASSOCIATION_IN_FRONT), known & (nearer > 0.0f) & (square > high * variance));  // L1:8
    code = select(code, (int8)(ASSOCIATION_BEHIND), known & (nearer < 0.0f) & (square > high * variance));
    vstore8(convert_uchar8(code), 0, codes + at);
}
