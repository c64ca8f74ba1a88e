/* Depth-aware connected components of a map of members (Fig 14c; also of the touch map). Four neighbours; two are
 * connected when both are members and their depths differ by less than a gap. Union-find over map indices: labels only
 * decrease, a root is its own label and the first pixel of its component, row by row. */

INLINE int8 connected8(const ConnectionParams params, const float8 a_m, const float8 b_m) {
    const float8 z = fmin(a_m, b_m);
    return fabs(a_m - b_m) < fmax(params.gap_sigmas * sigma_z8(params.noise, z), params.gap_per_m * z);
}

/* -1 in each lane that is connected to the lane before it; before_* is the pixel left of the first lane. */
INLINE int8 connected_to_left8(const ConnectionParams params, const float8 z, const int8 member, const float before_m,
                               const int before_member) {
    const float8 left_m = (float8)(before_m, z.s0123, z.s45, z.s6);
    const int8 left_member = (int8)(before_member, member.s0123, member.s45, member.s6);
    return member & left_member & connected8(params, z, left_m);
}

INLINE int find_root(volatile __global int* labels, int i) {
    int parent = labels[i];
    while (parent != i) {
        i = parent;
        parent = labels[i];
    }
    return i;
}

INLINE void unite(volatile __global int* labels, int a, int b) {
    while (true) {
        a = find_root(labels, a);
        b = find_root(labels, b);
        if (a == b) return;
        const int low = min(a, b), high = max(a, b);
        const int old = atomic_min(labels + high, low);
        if (old == high) return;
        a = old;
        b = low;
    }
}

/* Labels of runs within eight pixels: the index of the run's first pixel; -1 where there is no member. */
__kernel void label_runs(__global const uchar* members, __global const float* depth_m, __global int* labels,
                         const MapShape shape, const ConnectionParams params) {
    const int at = (int)get_global_id(1) * shape.pitch_px + (int)get_global_id(0) * 8;
    const int8 member = convert_int8(vload8(0, members + at)) != 0;
    if (!any(member)) {
        vstore8((int8)(-1), 0, labels + at);
        return;
    }
    const int8 linked = connected_to_left8(params, vload8(0, depth_m + at), member, 0.0f, 0);
    int8 label = select((int8)(-1), convert_int8(lanes8()) + at, member);
    int links[8], run[8];
    vstore8(linked, 0, links);
    vstore8(label, 0, run);
    for (int i = 1; i < 8; ++i) run[i] = links[i] ? run[i - 1] : run[i];
    vstore8(vload8(0, run), 0, labels + at);
}

/* Unites runs with the pixel to the left of the eight and with the row above. A union that follows from the three
 * other links of a square of four pixels is left out. */
__kernel void merge_runs(__global const uchar* members, __global const float* depth_m, volatile __global int* labels,
                         const MapShape shape, const ConnectionParams params) {
    const int x = (int)get_global_id(0) * 8, y = (int)get_global_id(1), at = y * shape.pitch_px + x;
    const int8 member = convert_int8(vload8(0, members + at)) != 0;
    if (!any(member)) return;
    const float8 z = vload8(0, depth_m + at);
    const int before = x > 0 ? at - 1 : at, before_member = x > 0 && members[before] != 0 ? -1 : 0;
    const int8 left = connected_to_left8(params, z, member, depth_m[before], before_member);
    if (left.s0) unite(labels, at, before);
    if (y == 0) return;
    const int above = at - shape.pitch_px;
    const int8 above_member = convert_int8(vload8(0, members + above)) != 0;
    const float8 above_m = vload8(0, depth_m + above);
    const int8 up = member & above_member & connected8(params, z, above_m);
    const int8 above_left = connected_to_left8(params, above_m, above_member, 0.0f, 0);
    const int8 before_up = (int8)(0, up.s0123, up.s45, up.s6);
    const int8 wanted = up & ~(left & before_up & above_left);
    if (!any(wanted)) return;
    int unions[8];
    vstore8(wanted, 0, unions);
    for (int i = 0; i < 8; ++i) {
        if (unions[i]) unite(labels, at + i, above + i);
    }
}

/* Labels become roots; each root takes a place in the list of components, in no particular order, with empty sums. */
__kernel void list_roots(volatile __global int* labels, __global int* places, __global ComponentSums* sums,
                         volatile __global int* count, const MapShape shape) {
    const int at = (int)get_global_id(1) * shape.pitch_px + (int)get_global_id(0) * 8;
    int label[8];
    const int8 first = vload8(0, (__global const int*)labels + at);
    if (all(first < 0)) return;
    vstore8(first, 0, label);
    for (int i = 0, last_label = -1, last_root = -1; i < 8; ++i) {
        if (label[i] < 0) continue;
        if (label[i] != last_label) {
            last_label = label[i];
            last_root = find_root(labels, last_label);
        }
        labels[at + i] = last_root;
        if (last_root != at + i) continue;
        const int place = atomic_inc(count);
        places[at + i] = place;
        const ComponentSums empty = {at + i, 0, 0, 0, INT_MAX, INT_MAX, -1, -1, 0, 0, 0, 0};
        sums[place] = empty;
    }
}

INLINE void add_sums(__global ComponentSums* to, const ComponentSums s) {
    atomic_add(&to->pixels, s.pixels);
    if (s.seeds) atomic_add(&to->seeds, s.seeds);
    if (s.unknowns) atomic_add(&to->unknowns, s.unknowns);
    if (s.expected) atomic_add(&to->expected, s.expected);
    atomic_min(&to->min_x, s.min_x);
    atomic_min(&to->min_y, s.min_y);
    atomic_max(&to->max_x, s.max_x);
    atomic_max(&to->max_y, s.max_y);
    atomic_add(&to->depth_mm_low, s.depth_mm_low & 0xffff);
    if (s.depth_mm_low >> 16) atomic_add(&to->depth_mm_high, s.depth_mm_low >> 16);
}

/* Adds up half a tile a work-item, so that a component costs few atomics: global size (pitch / 8, rows / 16). */
__kernel void sum_components(__global const uchar* members, __global const float* depth_m, __global const int* labels,
                             __global const int* places, __global ComponentSums* sums, const MapShape shape) {
    const int x = (int)get_global_id(0) * 8, first_y = (int)get_global_id(1) * TILE_PX;
    const ComponentSums empty = {-1, 0, 0, 0, INT_MAX, INT_MAX, -1, -1, 0, 0, 0, 0};
    ComponentSums s = empty;
    for (int y = first_y; y < first_y + TILE_PX; ++y) {
        const int at = y * shape.pitch_px + x;
        if (all(vload8(0, labels + at) < 0)) continue;
        for (int i = 0; i < 8; ++i) {
            const int root = labels[at + i];
            if (root < 0) continue;
            if (root != s.root) {
                if (s.root >= 0) add_sums(sums + places[s.root], s);
                s = empty;
                s.root = root;
            }
            const uchar member = members[at + i], kind = member & (MEMBER_EXPECTED - 1);
            ++s.pixels;
            s.seeds += kind == MEMBER_SEED;
            s.unknowns += kind == MEMBER_UNKNOWN;
            s.expected += (member & MEMBER_EXPECTED) != 0;
            s.min_x = min(s.min_x, x + i);
            s.min_y = min(s.min_y, y);
            s.max_x = max(s.max_x, x + i);
            s.max_y = max(s.max_y, y);
            s.depth_mm_low += convert_int_rte(depth_m[at + i] * 1000.0f);
        }
    }
    if (s.root >= 0) add_sums(sums + places[s.root], s);
}

/* Labels are the numbers that the host gave to the places (-1: dropped); mask is 255 where there is a number. */
__kernel void number_components(__global const int* roots, __global const int* places, __global const int* numbers,
                                __global int* labels, __global uchar* mask, const MapShape shape) {
    const int at = (int)get_global_id(1) * shape.pitch_px + (int)get_global_id(0) * 8;
    const int8 root = vload8(0, roots + at);
    if (all(root < 0)) {
        vstore8((int8)(-1), 0, labels + at);
        vstore8((uchar8)(0), 0, mask + at);
        return;
    }
    const int8 place = gather_int8(places, root);
    const int8 number = gather_int8(numbers, place);
    vstore8(number, 0, labels + at);
    vstore8(select((uchar8)(0), (uchar8)(255), convert_char8(number >= 0)), 0, mask + at);
}
