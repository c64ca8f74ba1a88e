#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace touchstone {

/// Puts `bytes` in the file at `path`: readers, and a power cut, see the old content or the whole new one.
/// Written beside it, flushed to the disk, then renamed. The folder must exist, and the path must
/// not be a folder, a device or the like. Throws Error{io_error}.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Throws Error{io_error} where a file cannot be written at `path` now: before hours of work for it. Changes
/// nothing.
void check_writable(const std::filesystem::path& path);

/// The same for a library that writes a file by its name: it writes to name(), an empty file beside `path`
/// at first. Removed unless commit() puts it in its place.
class PendingFile {
  public:
    /// Throws Error{io_error}.
    explicit PendingFile(std::filesystem::path path);
    ~PendingFile();
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;

    const std::string& name() const { return name_; }
    /// Once, after the library has closed it. Throws Error{io_error}.
    void commit();

  private:
    std::filesystem::path path_;
    std::string name_;
    bool committed_ = false;
};

}  // namespace touchstone
