/* What a Kinect's column bands drift by: histograms of the residual in 1/z over the still background, column by column.
 * counts and sums: DRIFT_ZONES x DRIFT_BINS planes of pitch values. Eight columns of one zone a work-item: global size
 * (pitch / 8, DRIFT_ZONES). */
__kernel void column_residuals(__global const float* live_m, __global const float* model_m,
                               __global const uchar* excluded, __global float* counts, __global float* sums, const MapShape shape,
                               const DriftParams params) {
    const int x = (int)get_global_id(0) * 8, zone = (int)get_global_id(1), pitch = shape.pitch_px;
    const int zone_rows = (shape.height_px + DRIFT_ZONES - 1) / DRIFT_ZONES;
    const int end = min(shape.height_px, (zone + 1) * zone_rows);
    /* Below threshold t; bins are the differences. */
    float8 below[DRIFT_BINS + 1], sum_below[DRIFT_BINS + 1];
    for (int t = 0; t <= DRIFT_BINS; ++t) below[t] = sum_below[t] = (float8)(0.0f);
    for (int y = zone * zone_rows + params.first_row; y < end; y += params.row_step) {
        const int at = y * pitch + x;
        const float8 live = vload8(0, live_m + at), model = vload8(0, model_m + at);
        const int8 used = (live > 0.0f) & (model > 0.0f) & (convert_int8(vload8(0, excluded + at)) == 0);
        if (!any(used)) continue;
        const float8 residual = select((float8)(FLT_MAX), 1.0f / live - 1.0f / model, used);
        for (int t = 0; t <= DRIFT_BINS; ++t) {
            const int8 is_below = residual < params.bin_per_m * (float)(t - DRIFT_BINS / 2);
            below[t] += select((float8)(0.0f), (float8)(1.0f), is_below);
            sum_below[t] += select((float8)(0.0f), residual, is_below);
        }
    }
    for (int t = 0; t < DRIFT_BINS; ++t) {
        const int to = (zone * DRIFT_BINS + t) * pitch + x;
        vstore8(below[t + 1] - below[t], 0, counts + to);
        vstore8(sum_below[t + 1] - sum_below[t], 0, sums + to);
    }
}
