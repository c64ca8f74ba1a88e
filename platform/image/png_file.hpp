#pragma once

#include <filesystem>

#include "platform/image/image.hpp"

namespace touchstone {

/// Reads a PNG of 16 bit gray. Throws Error: no_input (no such file), bad_data (not a PNG, damaged, cut
/// short, or of another kind); the message names the file.
Image16 read_png_16(const std::filesystem::path& path);

/// Reads any other PNG as gray, RGB or RGBA of 8 bit (palettes and 1, 2, 4 bit are widened). Throws Error
/// like read_png_16; 16 bit is refused.
Image8 read_png_8(const std::filesystem::path& path);

/// Writes at zlib's fastest level. Throws Error{io_error}; std::invalid_argument where the pixels do not fit
/// the size.
void write_png(const std::filesystem::path& path, const Image8& image);
void write_png(const std::filesystem::path& path, const Image16& image);

}  // namespace touchstone
