/* What stands still while the surroundings are scanned. Per pixel the depth that is taken to be the background, with the mean of
 * the frames that showed it, and another one that may replace it: farther is behind, and what was before it has moved. */

/* Eight pixels a work-item; global size (pitch / 8, rows). Depths that are not the background's become 0 in both maps, and
 * `moving` is 255 there. A depth that differs from the background's by less than so many standard deviations is the background's;
 * another one replaces it when it is seen in least_frames in a row and lies behind it, or that was not seen so often. `replaced`
 * stays 255 from then on. */
__kernel void judge_stillness(__global float* depth_m, __global float* filtered_m, __global float* mean_m,
                              __global uchar* frames, __global float* other_m, __global uchar* other_frames,
                              __global uchar* moving, __global uchar* replaced, const MapShape shape,
                              const SensorNoise noise, const float quantisation_per_m, const float sigmas,
                              const int least_frames) {
    const int at = (int)get_global_id(1) * shape.pitch_px + (int)get_global_id(0) * 8;
    const float8 z = vload8(0, depth_m + at);
    const int8 measured = z > 0.0f;
    const uchar8 was_moved = vload8(0, replaced + at);
    if (!any(measured)) {
        vstore8((uchar8)(0), 0, moving + at);
        return;
    }
    float8 mean = vload8(0, mean_m + at), other = vload8(0, other_m + at);
    int8 n = convert_int8(vload8(0, frames + at)), m = convert_int8(vload8(0, other_frames + at));
    const float8 sigma = sigma_z8(noise, z), step = quantisation_per_m * z * z;
    const float8 tolerance = sigmas * sqrt(sigma * sigma + step * step);
    const int8 first = measured & (n == 0);
    const int8 fits = measured & ~first & (fabs(z - mean) < tolerance);
    const int8 strange = measured & ~first & ~fits;
    const int8 again = strange & (m > 0) & (fabs(z - other) < tolerance);
    n = select(n, min(n + 1, 250), first | fits);
    mean = select(mean, mean + (z - mean) / convert_float8(n), fits);
    mean = select(mean, z, first);
    m = select(m, min(m + 1, 250), again);
    other = select(other, other + (z - other) / convert_float8(max(m, 1)), again);
    other = select(other, z, strange & ~again);
    m = select(m, 1, strange & ~again);
    m = select(m, 0, fits);
    const int8 farther = (other > mean) | (n < least_frames);
    const int8 replaces = again & (m >= least_frames) & farther;
    mean = select(mean, other, replaces);
    n = select(n, m, replaces);
    m = select(m, 0, replaces);
    const int8 moves = strange & ~replaces;
    vstore8(mean, 0, mean_m + at);
    vstore8(other, 0, other_m + at);
    vstore8(convert_uchar8(n), 0, frames + at);
    vstore8(convert_uchar8(m), 0, other_frames + at);
    vstore8(convert_uchar8(moves & 255), 0, moving + at);
    vstore8(was_moved | convert_uchar8(replaces & 255), 0, replaced + at);
    vstore8(select(z, (float8)(0.0f), moves), 0, depth_m + at);
    vstore8(select(vload8(0, filtered_m + at), (float8)(0.0f), moves), 0, filtered_m + at);
}
