#pragma once

#include <filesystem>
#include <string_view>

namespace touchstone {

/// Puts `bytes` in the file at `path`: readers, and a power cut, see the old content or the whole new one.
/// Written beside it, flushed to the disk, then renamed. The folder must exist, and the path must
/// not be a folder, a device or the like. Throws Error{io_error}.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Throws Error{io_error} where a file cannot be written at `path` now: before hours of work for it. Changes
/// nothing.
void check_writable(const std::filesystem::path& path);

}  // namespace touchstone
