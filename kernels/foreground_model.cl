/* The moving foreground's volumes (Fig 14e): what of a frame belongs to one component, and the picture that the predictions of
 * all volumes and the live depth make together. Eight pixels a work-item. */

/* Of the component `label`: its sample weights; the same with SAMPLE_FREE_ONLY where no component is; and 0 on it, 255 elsewhere. */
__kernel void pick_component(__global const int* labels, __global const uchar* sample_weights, __global uchar* own,
                             __global uchar* with_free, __global uchar* others, const MapShape shape, const int label) {
    const int at = (int)get_global_id(1) * shape.pitch_px + (int)get_global_id(0) * 8;
    const int8 component = vload8(0, labels + at);
    const uchar8 weights = vload8(0, sample_weights + at);
    const uchar8 is_own = convert_uchar8(component == label), is_none = convert_uchar8(component < 0);
    vstore8(weights & is_own, 0, own + at);
    vstore8((weights & is_own) | ((uchar8)(SAMPLE_FREE_ONLY) & is_none), 0, with_free + at);
    vstore8(~is_own, 0, others + at);
}

/* Takes back what pick_component gave. */
__kernel void drop_component(__global uchar* own, __global uchar* with_free, __global uchar* others, const MapShape shape) {
    const int at = (int)get_global_id(1) * shape.pitch_px + (int)get_global_id(0) * 8;
    vstore8((uchar8)(0), 0, own + at);
    vstore8((uchar8)(0), 0, with_free + at);
    vstore8((uchar8)(255), 0, others + at);
}

__kernel void no_prediction(__global float* depth_m, const MapShape shape) {
    vstore8((float8)(0.0f), 0, depth_m + (int)get_global_id(1) * shape.pitch_px + (int)get_global_id(0) * 8);
}

/* The live surface on the mask, nothing elsewhere. */
__kernel void take_live(__global const uchar* mask, __global const float* live_m, __global const float* live_normals_c,
                        __global float* depth_m, __global float* normals_c, __global uchar* source, const MapShape shape) {
    const int at = (int)get_global_id(1) * shape.pitch_px + (int)get_global_id(0) * 8, plane = shape.pitch_px * shape.rows_px;
    const int8 moving = convert_int8(vload8(0, mask + at)) != 0;
    if (!any(moving) && !any(vload8(0, depth_m + at) > 0.0f)) return;
    vstore8(select((float8)(0.0f), vload8(0, live_m + at), moving), 0, depth_m + at);
    for (int i = 0; i < 3; ++i)
        vstore8(select((float8)(0.0f), vload8(0, live_normals_c + i * plane + at), moving), 0, normals_c + i * plane + at);
    vstore8(convert_uchar8(moving) & (uchar8)(FOREGROUND_LIVE), 0, source + at);
}

/* Whether a pixel of the component is at most two pixels away. */
INLINE int8 is_beside8(__global const int* labels, const MapShape shape, const int x, const int y, const int label) {
    int8 beside = (int8)(0);
    if (x < 8 || x + 16 > shape.pitch_px || y < 2 || y + 2 >= shape.rows_px) return beside;
    for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i) beside |= vload8(0, labels + (y + j) * shape.pitch_px + x + i) == label;
    return beside;
}

/* A volume's prediction where its component is and the live depth does not contradict it (within gate_sigmas), and where
 * nothing was measured beside the component. Eight pixels a work-item. */
__kernel void take_prediction(__global const int* labels, __global const float* live_m, __global const float* model_m,
                              __global const float* model_normals_c, __global float* depth_m, __global float* normals_c,
                              __global uchar* source, const MapShape shape, const SensorNoise noise, const float gate_sigmas,
                              const int label) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1);
    const int at = y * shape.pitch_px + x, plane = shape.pitch_px * shape.rows_px;
    const float8 model = vload8(0, model_m + at), live = vload8(0, live_m + at);
    const int8 component = vload8(0, labels + at), predicted = model > 0.0f;
    if (!any(predicted)) return;
    const int8 agrees = fabs(model - live) < gate_sigmas * sigma_z8(noise, live);
    int8 taken = predicted & (component == label) & agrees;
    const int8 holes = predicted & (component < 0) & (live <= 0.0f);
    if (any(holes)) taken |= holes & is_beside8(labels, shape, x, y, label);
    if (!any(taken)) return;
    vstore8(select(vload8(0, depth_m + at), model, taken), 0, depth_m + at);
    for (int i = 0; i < 3; ++i) {
        __global float* normals = normals_c + i * plane + at;
        vstore8(select(vload8(0, normals), vload8(0, model_normals_c + i * plane + at), taken), 0, normals);
    }
    const uchar8 here = convert_uchar8(taken);
    vstore8((vload8(0, source + at) & ~here) | ((uchar8)(FOREGROUND_MODEL) & here), 0, source + at);
}
