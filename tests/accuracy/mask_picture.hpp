#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "platform/image/image.hpp"

namespace touchstone {

/// Depth as gray; green where truth and mask agree, blue where the mask lacks a pixel, red where it has one
/// too many. `counted`: not 0 where a pixel counts; the others stay gray. All of one size.
Image8 mask_picture(const Image16& depth_mm, std::span<const std::uint8_t> truth,
                    std::span<const std::uint8_t> mask, std::span<const std::uint8_t> counted);

}  // namespace touchstone
