#pragma once

#include <filesystem>

#include "platform/image/image.hpp"

namespace touchstone {

/// Reads a JPEG as RGB. Throws Error: no_input (no such file), bad_data (not a JPEG, damaged or cut short);
/// the message names the file.
Image8 read_jpeg_rgb(const std::filesystem::path& path);

}  // namespace touchstone
