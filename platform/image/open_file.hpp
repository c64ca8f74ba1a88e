#pragma once

#include <cerrno>
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

}  // namespace touchstone
