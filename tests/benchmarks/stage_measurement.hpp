#pragma once

#include <algorithm>
#include <benchmark/benchmark.h>
#include <ctime>
#include <vector>

#include "platform/system/percentile.hpp"
#include "tests/benchmarks/stopwatch.hpp"

namespace touchstone {

/// Runs `work` for each iteration and reports median, 99th percentile and least, and `cpu_ms`: the time of
/// all cores, mean of an iteration, which a busy machine changes little. `bytes` is what one run must move
/// at least, `triad_gb_s` what the machine moves in this run.
template <class Work>
void measure(benchmark::State& state, double bytes, double triad_gb_s, const Work& work) {
    std::vector<double> times_ms;
    work();
    const std::clock_t cpu_start = std::clock();
    for ([[maybe_unused]] auto iteration : state) times_ms.push_back(time_ms(work));
    const double cpu_ms = 1e3 * static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
    const double median_ms = percentile(times_ms, 50.0);
    state.counters["median_ms"] = median_ms;
    state.counters["p99_ms"] = percentile(times_ms, 99.0);
    state.counters["min_ms"] = percentile(times_ms, 0.0);
    state.counters["cpu_ms"] = cpu_ms / static_cast<double>(times_ms.size());
    const double gb_s = bytes * 1e-6 / median_ms;
    state.counters["GB/s"] = gb_s;
    state.counters["of triad"] = gb_s / triad_gb_s;
}

}  // namespace touchstone
