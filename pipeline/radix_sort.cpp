#include "pipeline/radix_sort.hpp"

#include "kernels/shared_types.h"
#include "pipeline/kernel_program.hpp"
#include "pipeline/map_shape.hpp"

namespace touchstone {

RadixSort::RadixSort(const Device& device, std::size_t capacity)
    : program_(load_kernel_program(device, "radix_sort.cl")),
      count_digits_(program_.kernel("count_digits")),
      scan_counts_(program_.kernel("scan_counts")),
      scatter_(program_.kernel("scatter")),
      counts_(device, SORT_DIGITS * ceil_div(capacity, SORT_RUN)),
      keys_(device, capacity),
      places_(device, capacity) {}

void RadixSort::sort(Buffer<int>& keys, Buffer<int>& places, int count) {
    if (count == 0) return;
    pass(keys, places, keys_, places_, count, 0);
    pass(keys_, places_, keys, places, count, SORT_BITS);
}

void RadixSort::pass(const Buffer<int>& keys, const Buffer<int>& places, Buffer<int>& sorted_keys,
                     Buffer<int>& sorted_places, int count, int shift) {
    const std::size_t runs = ceil_div(static_cast<std::size_t>(count), SORT_RUN);
    const LaunchSize one_run_each{{runs, 1, 1}, {1, 1, 1}};
    count_digits_.launch(one_run_each, keys, counts_, count, static_cast<int>(runs), shift);
    scan_counts_.launch({}, counts_, static_cast<int>(SORT_DIGITS * runs));
    scatter_.launch(one_run_each, keys, places, counts_, sorted_keys, sorted_places, count,
                    static_cast<int>(runs), shift);
}

}  // namespace touchstone
