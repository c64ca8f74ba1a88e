/* Least significant digit radix sort of keys below 2^18 with their places, two passes of nine bits: stable, so that what follows
 * is the same on every device. A work-item counts, and then scatters, one run of SORT_RUN values in order. */

/* counts[digit * runs + run]: how many values of the run have the digit. */
__kernel void count_digits(__global const int* keys, __global int* counts, const int count, const int runs, const int shift) {
    const int run = (int)get_global_id(0);
    if (run >= runs) return;
    int histogram[SORT_DIGITS] = {0};
    for (int i = run * SORT_RUN; i < min(run * SORT_RUN + SORT_RUN, count); ++i) ++histogram[(keys[i] >> shift) & (SORT_DIGITS - 1)];
    for (int digit = 0; digit < SORT_DIGITS; ++digit) counts[digit * runs + run] = histogram[digit];
}

/* Sums of all before each; one work-item. */
__kernel void scan_counts(__global int* counts, const int size) {
    int sum = 0;
    for (int i = 0; i < size; ++i) {
        const int here = counts[i];
        counts[i] = sum;
        sum += here;
    }
}

__kernel void scatter(__global const int* keys, __global const int* places, __global const int* first, __global int* sorted_keys,
                      __global int* sorted_places, const int count, const int runs, const int shift) {
    const int run = (int)get_global_id(0);
    if (run >= runs) return;
    int next[SORT_DIGITS];
    for (int digit = 0; digit < SORT_DIGITS; ++digit) next[digit] = first[digit * runs + run];
    for (int i = run * SORT_RUN; i < min(run * SORT_RUN + SORT_RUN, count); ++i) {
        const int key = keys[i], to = next[(key >> shift) & (SORT_DIGITS - 1)]++;
        sorted_keys[to] = key;
        sorted_places[to] = places[i];
    }
}
