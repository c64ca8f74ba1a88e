#pragma once

#include "platform/opencl/program.hpp"

namespace touchstone {

/// Sorts keys of 18 bits with a place each on the device, by radix: equal keys keep their order.
class RadixSort {
  public:
    RadixSort(const Device& device, std::size_t capacity);

    /// The first `count` values of both, count at most the capacity. Keys 0..262143.
    void sort(Buffer<int>& keys, Buffer<int>& places, int count);

  private:
    void pass(const Buffer<int>& keys, const Buffer<int>& places, Buffer<int>& sorted_keys,
              Buffer<int>& sorted_places, int count, int shift);

    Program program_;
    Kernel count_digits_, scan_counts_, scatter_;
    Buffer<int> counts_, keys_, places_;
};

}  // namespace touchstone
