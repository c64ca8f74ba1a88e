#include "platform/system/atomic_file.hpp"

#include <cerrno>
#include <fcntl.h>
#include <fmt/core.h>
#include <fstream>
#include <iterator>
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

void write_and_flush(Descriptor& file, std::string_view bytes, const std::filesystem::path& path) {
    write_all(file.get(), bytes, path);
    if (::fsync(file.get()) != 0) fail(path, "flush", errno);
    if (!file.close()) fail(path, "close", errno);
}

/// A second name where the file system knows such, else a copy: the first name is never gone.
void name_also(const std::filesystem::path& path, const std::string& other) {
    ::unlink(other.c_str());
    if (::link(path.c_str(), other.c_str()) == 0) return;
    std::ifstream source(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(source), {}};
    if (!source) fail(other, "copy", EIO);
    Descriptor copy(::open(other.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666));
    if (copy.get() < 0) fail(other, "copy", errno);
    write_and_flush(copy, bytes, other);
}

/// Best effort: that the old content cannot be kept is no reason to refuse the new one.
void keep_previous(const std::filesystem::path& path) {
    const std::string previous = previous_of(path), next = beside(previous);
    TemporaryFile temporary(next);
    try {
        name_also(path, next);
        if (::rename(next.c_str(), previous.c_str()) == 0) temporary.keep();
    } catch (const Error&) {
        // Such as a disk without room for both.
    }
}

/// Of a file beside `path` whose bytes are on the disk.
void put_in_place(const std::filesystem::path& path, Previous previous = Previous::untouched) {
    if (previous == Previous::kept) keep_previous(path);
    if (::rename(beside(path).c_str(), path.c_str()) != 0) fail(path, "rename", errno);
    if (previous == Previous::removed) ::unlink(previous_of(path).c_str());
}

}  // namespace

void check_writable(const std::filesystem::path& path) {
    const Descriptor file = open_beside(path);
    const TemporaryFile temporary(beside(path));
}

std::filesystem::path previous_of(const std::filesystem::path& path) { return path.string() + ".previous"; }

std::vector<std::filesystem::path> names_of(const std::filesystem::path& path) {
    const std::filesystem::path previous = previous_of(path);
    return {path, previous, beside(path), beside(previous)};
}

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes, Previous previous) {
    Descriptor file = open_beside(path);
    TemporaryFile temporary(beside(path));
    write_and_flush(file, bytes, path);
    put_in_place(path, previous);
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
    write_and_flush(file, {}, path_);
    put_in_place(path_);
    committed_ = true;
    sync_folder(path_);
}

}  // namespace touchstone
