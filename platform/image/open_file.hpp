#pragma once

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fmt/core.h>
#include <memory>
#include <system_error>

#include "platform/system/error.hpp"

namespace touchstone {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using FilePtr = std::unique_ptr<std::FILE, CloseFile>;

/// Throws Error{status} that names the file and the system's reason.
inline FilePtr open_file(const std::filesystem::path& path, const char* mode, ExitStatus status) {
    FilePtr file(std::fopen(path.c_str(), mode));
    if (!file) {
        throw Error(status,
                    fmt::format("cannot open {}: {}", path.string(), std::generic_category().message(errno)));
    }
    return file;
}

inline constexpr std::uint64_t most_pixels = 100'000'000;

/// Why a picture cannot be as large as its header says, before memory is taken for it; null where it can.
inline const char* size_problem(const std::filesystem::path& path, std::uint64_t width_px,
                                std::uint64_t height_px, std::uint64_t most_pixels_per_byte) {
    std::error_code none;
    const std::uintmax_t bytes = std::filesystem::file_size(path, none);
    if (none || width_px * height_px > most_pixels) return "it is larger than 100 megapixels";
    return width_px * height_px > bytes * most_pixels_per_byte ? "it claims more pixels than it can hold"
                                                               : nullptr;
}

}  // namespace touchstone
