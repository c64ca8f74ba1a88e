#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace touchstone::sim {

/// SplitMix64's finaliser: any two inputs give unrelated outputs.
inline std::uint64_t mix64(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31);
}

/// One stream of pseudo-random numbers. Equal seed and stream give equal numbers on every machine.
class Random {
  public:
    Random(std::uint64_t seed, std::uint64_t stream) : state_(mix64(mix64(seed) ^ mix64(~stream))) {}

    std::uint64_t bits() { return mix64(state_++); }
    float uniform() { return static_cast<float>(bits() >> 40) * 0x1p-24F; }
    float uniform(float least, float most) { return least + (most - least) * uniform(); }
    /// 0 to count - 1
    int below(int count) { return static_cast<int>(bits() % static_cast<std::uint64_t>(count)); }
    bool chance(float probability) { return uniform() < probability; }
    /// Mean 0, variance 1 (Box-Muller).
    float normal() {
        const float radius = std::sqrt(-2.0F * std::log(1.0F - uniform()));
        return radius * std::cos(2.0F * std::numbers::pi_v<float> * uniform());
    }

  private:
    std::uint64_t state_;
};

}  // namespace touchstone::sim
