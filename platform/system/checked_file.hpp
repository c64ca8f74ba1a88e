#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace touchstone {

/// What a kind of file is called, how it is told from others, and what is believed of it.
struct FileFormat {
    std::string_view name;  ///< for people: "scan"
    std::array<char, 8> magic;
    std::uint32_t version;
    std::uint64_t max_content_bytes;  ///< more is refused before memory is taken for it
};

inline constexpr std::size_t checked_file_header_bytes = 40;

/// Compresses `content` and puts it in the file at `path`, the whole of it or nothing, also where the power
/// goes meanwhile. The content before it is kept as previous_of(path), unless it is damaged. The same content
/// gives the same bytes. Little endian: 8 bytes magic; u32 version; u32 0; u64 bytes of the content; u64
/// bytes that follow the header; u64 XXH3-64 of the 32 bytes before it and of what follows; a zstd frame.
/// Throws Error{io_error}; what was there is there then.
void write_checked_file(const std::filesystem::path& path, const FileFormat& format,
                        std::string_view content);

/// The same without a previous one: for what can be made again at once.
void write_checked_cache(const std::filesystem::path& path, const FileFormat& format,
                         std::string_view content);

/// The content again. Where the file is damaged or of another version, that of the previous one, if that is
/// whole, which is said in the log; a file that is missing was taken away on purpose. Throws Error{no_input}
/// where the file cannot be opened, Error{bad_data} where neither is of this kind and version, whole and of a
/// size that is believed. The message names the file.
std::string read_checked_file(const std::filesystem::path& path, const FileFormat& format);

}  // namespace touchstone
