#pragma once

#include <random>
#include <string>
#include <vector>

namespace touchstone::fuzz {

/// A malformed relative of one of the seeds: some bits, numbers, pieces and words of it changed. The same
/// random numbers give the same input.
std::string mutated(const std::vector<std::string>& seeds, std::mt19937& random);

}  // namespace touchstone::fuzz
