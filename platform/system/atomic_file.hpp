#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace touchstone {

/// What becomes of the file that lies at previous_of(path) when a new one takes its place.
enum class Previous {
    untouched,
    kept,     ///< the old content goes there
    removed,  ///< there was no old content: what lies there is of something that was given up
};

/// Where the content before the last write is kept: path + ".previous".
std::filesystem::path previous_of(const std::filesystem::path& path);

/// Every name under which content of the file at `path` may lie: itself, the previous one, and what a power
/// cut leaves of a write of either.
std::vector<std::filesystem::path> names_of(const std::filesystem::path& path);

/// Puts `bytes` in the file at `path`: readers, and a power cut, see the old content or the whole new one.
/// Written beside it, flushed to the disk, then renamed, and the folder flushed. The folder must exist, and
/// the path must not be a folder, a device or the like. Throws Error{io_error}; the old content is there
/// then, a full disk included.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes,
                           Previous previous = Previous::untouched);

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
