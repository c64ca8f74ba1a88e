#pragma once

#include <chrono>

namespace touchstone {

/// Milliseconds that `work` takes.
template <class Work>
double time_ms(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    return time.count();
}

}  // namespace touchstone
