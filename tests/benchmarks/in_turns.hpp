#pragma once

#include <vector>

#include "platform/system/percentile.hpp"
#include "tests/benchmarks/stopwatch.hpp"

namespace touchstone {

/// Times of two pieces of work that took turns, so that whatever else the machine does hits both alike.
struct Turns {
    std::vector<double> first_ms, second_ms;

    double first_median_ms() const { return percentile(first_ms, 50.0); }
    double second_median_ms() const { return percentile(second_ms, 50.0); }
    double median_ratio() const { return first_median_ms() / second_median_ms(); }
    /// Of the shortest times: what is left when nothing else runs.
    double best_ratio() const { return percentile(first_ms, 0.0) / percentile(second_ms, 0.0); }
};

/// `rounds` times `block` runs of the one, then as many of the other; each ran once before.
template <class First, class Second>
Turns measure_in_turns(int rounds, int block, const First& first, const Second& second) {
    Turns turns;
    first();
    second();
    for (int round = 0; round < rounds; ++round) {
        for (int i = 0; i < block; ++i) turns.first_ms.push_back(time_ms(first));
        for (int i = 0; i < block; ++i) turns.second_ms.push_back(time_ms(second));
    }
    return turns;
}

}  // namespace touchstone
