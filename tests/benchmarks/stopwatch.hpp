#pragma once

#include <algorithm>
#include <benchmark/benchmark.h>
#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "platform/system/percentile.hpp"

namespace touchstone {

/// Medians in milliseconds of what was measured in this run, by name.
using Medians = std::map<std::string, double>;

/// Runs `work` for each iteration and reports median and 99th percentile; `bytes` is what one run of it must
/// move at least, `triad_gb_s` what the machine moves in this run.
template <class Work>
void measure(benchmark::State& state, Medians& medians, const std::string& name, double bytes,
             double triad_gb_s, const Work& work) {
    std::vector<double> times_ms;
    work();
    for ([[maybe_unused]] auto iteration : state) {
        const auto start = std::chrono::steady_clock::now();
        work();
        const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
        times_ms.push_back(time.count());
    }
    medians[name] = percentile(times_ms, 50.0);
    state.counters["median_ms"] = medians[name];
    state.counters["p99_ms"] = percentile(times_ms, 99.0);
    if (bytes <= 0.0) return;
    const double gb_s = bytes * 1e-6 / medians[name];
    state.counters["GB_s"] = gb_s;
    state.counters["of_triad"] = gb_s / triad_gb_s;
}

}  // namespace touchstone
