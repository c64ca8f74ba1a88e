#include "platform/system/atomic_file.hpp"

#include <cerrno>
#include <fcntl.h>
#include <fmt/core.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, std::string_view step, int code) {
    throw Error(ExitStatus::io_error, fmt::format("cannot write {}: {}: {}", path.string(), step,
                                                  std::generic_category().message(code)));
}

class Descriptor {
  public:
    explicit Descriptor(int fd) : fd_(fd) {}
    ~Descriptor() {
        if (fd_ >= 0) ::close(fd_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int get() const { return fd_; }
    /// False where the system reports a late write error.
    bool close() { return ::close(std::exchange(fd_, -1)) == 0; }

  private:
    int fd_;
};

/// Removes the temporary file unless it was renamed to its place.
class TemporaryFile {
  public:
    explicit TemporaryFile(std::string path) : path_(std::move(path)) {}
    ~TemporaryFile() {
        if (!path_.empty()) ::unlink(path_.c_str());
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    void keep() { path_.clear(); }

  private:
    std::string path_;
};

void write_all(int fd, std::string_view bytes, const std::filesystem::path& path) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(fd, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail(path, "write", errno);
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
    return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

void sync_folder(const std::filesystem::path& path) {
    const Descriptor folder(::open(folder_of(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (folder.get() < 0 || ::fsync(folder.get()) != 0) fail(path, "flush of the folder", errno);
}

/// The name of the temporary file is fixed: what a power cut leaves behind is used up by the next write
/// instead of piling up.
std::string beside(const std::filesystem::path& path) { return path.string() + ".new"; }

Descriptor open_beside(const std::filesystem::path& path) {
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(path, ignored);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
        throw Error(ExitStatus::io_error, fmt::format("cannot write {}: it is not a file", path.string()));
    const int fd = ::open(beside(path).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (fd < 0) fail(path, "make a file beside it", errno);
    return Descriptor(fd);
}

/// Flushes the file beside `path` to the disk and renames it.
void put_in_place(Descriptor& file, const std::filesystem::path& path) {
    if (::fsync(file.get()) != 0) fail(path, "flush", errno);
    if (!file.close()) fail(path, "close", errno);
    if (::rename(beside(path).c_str(), path.c_str()) != 0) fail(path, "rename", errno);
}

}  // namespace

void check_writable(const std::filesystem::path& path) {
    const Descriptor file = open_beside(path);
    const TemporaryFile temporary(beside(path));
}

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes) {
    Descriptor file = open_beside(path);
    TemporaryFile temporary(beside(path));
    write_all(file.get(), bytes, path);
    put_in_place(file, path);
    temporary.keep();
    sync_folder(path);
}

PendingFile::PendingFile(std::filesystem::path path) : path_(std::move(path)), name_(beside(path_)) {
    open_beside(path_);
}

PendingFile::~PendingFile() {
    if (!committed_) ::unlink(name_.c_str());
}

void PendingFile::commit() {
    Descriptor file(::open(name_.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC));
    if (file.get() < 0) fail(path_, "open the file beside it", errno);
    put_in_place(file, path_);
    committed_ = true;
    sync_folder(path_);
}

}  // namespace touchstone
