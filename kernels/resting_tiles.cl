/* Parts of the picture in which a fixed camera's background agrees with what is seen: they need no fusing. */

/* One tile a work-item; global size (tiles per row, rows of tiles). Sets the sample weights of a tile to 0 where it rests: it was
 * fused `young_frames` times, the running mean of (live - model) / sigma_z is within rest_sigmas, at most a tenth of what weighs has no
 * model, and it is not its turn (one frame in `period`). A frame counts mean_share in the mean. means, ages: of each
 * tile, kept from frame to frame. */
__kernel void rest_tiles(__global const float* live_m, __global const float* model_m, __global uchar* sample_weights,
                         __global float* means, __global int* ages, const MapShape shape, const SensorNoise noise,
                         const float mean_share, const float rest_sigmas, const int young_frames, const int period, const int frame) {
    const int tile_x = (int)get_global_id(0), tile_y = (int)get_global_id(1);
    const int tile = tile_y * (shape.pitch_px / TILE_PX) + tile_x;
    float8 sum = (float8)(0.0f), known = (float8)(0.0f), used = (float8)(0.0f);
    for (int j = 0; j < TILE_PX; ++j) {
        const int row = (tile_y * TILE_PX + j) * shape.pitch_px + tile_x * TILE_PX;
        for (int at = row; at < row + TILE_PX; at += 8) {
            const int8 weighs = convert_int8(vload8(0, sample_weights + at)) != 0;
            if (!any(weighs)) continue;
            const float8 live = vload8(0, live_m + at), model = vload8(0, model_m + at);
            const int8 compared = weighs & (model > 0.0f);
            sum += select((float8)(0.0f), (live - model) / sigma_z8(noise, live), compared);
            known += select((float8)(0.0f), (float8)(1.0f), compared);
            used += select((float8)(0.0f), (float8)(1.0f), weighs);
        }
    }
    const float count = sum8(known), all_used = sum8(used);
    if (all_used < 1.0f) return;
    if (count >= 0.9f * all_used) means[tile] += (sum8(sum) / count - means[tile]) * mean_share;
    const bool agrees = count >= 0.9f * all_used && fabs(means[tile]) < rest_sigmas;
    if (!agrees || ages[tile] < young_frames || (tile + frame) % period == 0) {
        ages[tile] = min(ages[tile] + 1, young_frames);
        return;
    }
    for (int j = 0; j < TILE_PX; ++j)
        vstore16((uchar16)(0), 0, sample_weights + (tile_y * TILE_PX + j) * shape.pitch_px + tile_x * TILE_PX);
}
