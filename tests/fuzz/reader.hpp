#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// One reader's harness, as libFuzzer calls it; the driver of a fixed count calls the same.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

namespace touchstone::fuzz {

/// Inputs that the reader of this harness takes, to begin with.
std::vector<std::string> seeds();

}  // namespace touchstone::fuzz
