#pragma once

#include <filesystem>
#include <string_view>

namespace touchstone {

/// Puts `bytes` in the file at `path`: readers, and a power cut, see the old content or the whole new one.
/// Written beside it, flushed to the disk, then renamed. The folder must exist. Throws Error{io_error}.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace touchstone
