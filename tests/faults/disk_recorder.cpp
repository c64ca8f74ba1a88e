#include "tests/faults/disk_recorder.hpp"

#include <cerrno>
#include <cstdarg>
#include <fcntl.h>
#include <fstream>
#include <functional>
#include <iterator>
#include <sys/syscall.h>
#include <unistd.h>

namespace touchstone::test {
namespace {

DiskRecorder* the_active = nullptr;

std::string name_in(const std::string& path) { return std::filesystem::path(path).filename().string(); }

/// What a file may hold whose last flush left `flushed` and which would hold `now` without the power cut.
std::string torn(const std::string& flushed, const std::string& now, std::mt19937& random) {
    const auto any = [&](std::size_t below) {
        return std::uniform_int_distribution<std::size_t>(0, below)(random);
    };
    switch (any(5)) {
        case 0:
            return flushed;
        case 1:
            return now;
        case 2:
            return now.substr(0, any(now.size()));
        case 3:
            return std::string(now.size(), '\0');
        case 4: {  // whole blocks came, others did not
            std::string mixed = now;
            for (std::size_t block = any(4); block * 512 < mixed.size(); block += 1 + any(4))
                for (std::size_t i = block * 512; i < std::min(mixed.size(), (block + 1) * 512); ++i)
                    mixed[i] = '\0';
            return mixed;
        }
        default: {
            std::string garbage(any(now.size()), '\0');
            for (char& byte : garbage) byte = static_cast<char>(random());
            return garbage;
        }
    }
}

}  // namespace

DiskRecorder::DiskRecorder(std::filesystem::path folder) : folder_(std::move(folder)) {
    for (const auto& [name, bytes] : content_of_folder(folder_)) names_[name] = files_++;
    the_active = this;
}

DiskRecorder::~DiskRecorder() { the_active = nullptr; }

DiskRecorder* DiskRecorder::active() { return the_active; }

void DiskRecorder::fail_at(int call, int code) {
    calls_until_failure_ = call;
    failure_ = code;
}

bool DiskRecorder::is_inside(const std::string& path) const {
    return std::filesystem::path(path).parent_path() == folder_;
}

std::optional<int> DiskRecorder::failure() {
    if (calls_until_failure_ < 0 || calls_until_failure_-- > 0) return std::nullopt;
    has_failed_ = true;
    return failure_;
}

int DiskRecorder::file_named(const std::string& name) {
    const auto known = names_.find(name);
    return known == names_.end() ? names_[name] = files_++ : known->second;
}

void DiskRecorder::opened(int descriptor, const std::string& path, bool existed, bool truncates) {
    const std::string name = name_in(path);
    const int file = file_named(name);
    open_[descriptor] = file;
    if (!existed) calls_.push_back({DiskCall::Kind::create, file, name, {}, {}});
    if (existed && truncates) calls_.push_back({DiskCall::Kind::truncate, file, name, {}, {}});
}

void DiskRecorder::wrote(int descriptor, std::string bytes) {
    calls_.push_back({DiskCall::Kind::write, open_.at(descriptor), {}, {}, std::move(bytes)});
}

void DiskRecorder::flushed(int descriptor) {
    if (is_folder(descriptor))
        calls_.push_back({DiskCall::Kind::flush_folder, -1, {}, {}, {}});
    else
        calls_.push_back({DiskCall::Kind::flush, open_.at(descriptor), {}, {}, {}});
}

void DiskRecorder::closed(int descriptor) {
    open_.erase(descriptor);
    if (is_folder(descriptor)) folder_descriptor_ = -1;
}

void DiskRecorder::linked(const std::string& from, const std::string& to) {
    const int file = file_named(name_in(from));
    names_[name_in(to)] = file;
    calls_.push_back({DiskCall::Kind::link, file, name_in(from), name_in(to), {}});
}

void DiskRecorder::renamed(const std::string& from, const std::string& to) {
    const int file = file_named(name_in(from));
    names_.erase(name_in(from));
    names_[name_in(to)] = file;
    calls_.push_back({DiskCall::Kind::rename, file, name_in(from), name_in(to), {}});
}

void DiskRecorder::removed(const std::string& path) {
    names_.erase(name_in(path));
    calls_.push_back({DiskCall::Kind::remove, -1, name_in(path), {}, {}});
}

DiskContent content_of_folder(const std::filesystem::path& folder) {
    DiskContent content;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        std::ifstream file(entry.path(), std::ios::binary);
        content[entry.path().filename().string()] = {std::istreambuf_iterator<char>(file), {}};
    }
    return content;
}

void put_content(const std::filesystem::path& folder, const DiskContent& content) {
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        std::filesystem::remove_all(entry.path());
    for (const auto& [name, bytes] : content) std::ofstream(folder / name, std::ios::binary) << bytes;
}

DiskContent after_power_cut(const DiskContent& before, const std::vector<DiskCall>& calls,
                            std::size_t calls_made, std::mt19937& random) {
    using Kind = DiskCall::Kind;
    using Names = std::map<std::string, int>;
    Names names;
    std::map<int, std::string> flushed, now;
    for (const auto& [name, bytes] : before) {  // numbered as a recorder does: by name
        const int file = static_cast<int>(names.size());
        names[name] = file;
        flushed[file] = now[file] = bytes;
    }
    std::vector<std::function<void(Names&)>> unflushed;
    const auto rename_later = [&](std::function<void(Names&)> step) { unflushed.push_back(std::move(step)); };
    for (std::size_t i = 0; i < calls_made; ++i) {
        const DiskCall& call = calls[i];
        switch (call.kind) {
            case Kind::create:
                rename_later([&call](Names& all) { all[call.name] = call.file; });
                break;
            case Kind::truncate:
                now[call.file].clear();
                break;
            case Kind::write:
                now[call.file] += call.bytes;
                break;
            case Kind::flush:
                flushed[call.file] = now[call.file];
                break;
            case Kind::link:
                rename_later([&call](Names& all) { all[call.other] = call.file; });
                break;
            case Kind::rename:
                rename_later([&call](Names& all) {
                    all.erase(call.name);
                    all[call.other] = call.file;
                });
                break;
            case Kind::remove:
                rename_later([&call](Names& all) { all.erase(call.name); });
                break;
            case Kind::flush_folder:
                for (const auto& step : unflushed) step(names);
                unflushed.clear();
                break;
        }
    }
    const bool in_order = random() % 2 == 0;
    const std::size_t first_lost = random() % (unflushed.size() + 1);
    for (std::size_t i = 0; i < unflushed.size(); ++i)
        if (in_order ? i < first_lost : random() % 2 == 0) unflushed[i](names);
    DiskContent after;
    for (const auto& [name, file] : names)
        after[name] = now[file] == flushed[file] ? now[file] : torn(flushed[file], now[file], random);
    return after;
}

}  // namespace touchstone::test

// They stand in for those of the C library, for all of this program.
namespace {

using touchstone::test::DiskRecorder;

long done(long result, auto record) {
    if (result >= 0) record();
    return result;
}

bool fails(DiskRecorder& recorder) {
    const auto code = recorder.failure();
    if (code) errno = *code;
    return code.has_value();
}

int open_file(const char* path, int flags, mode_t mode) {
    DiskRecorder* recorder = DiskRecorder::active();
    const bool is_folder = (flags & O_DIRECTORY) != 0, writes = (flags & O_ACCMODE) != O_RDONLY;
    const bool recorded = recorder && (is_folder ? recorder->is_inside(std::string(path) + "/x")
                                                 : writes && recorder->is_inside(path));
    if (!recorded) return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
    if (fails(*recorder)) return -1;
    const bool existed = syscall(SYS_faccessat, AT_FDCWD, path, F_OK) == 0;
    const int descriptor = static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
    if (descriptor < 0) return descriptor;
    if (is_folder)
        recorder->opened_folder(descriptor);
    else
        recorder->opened(descriptor, path, existed, (flags & O_TRUNC) != 0);
    return descriptor;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
    va_list more;
    va_start(more, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    return open_file(path, flags, mode);
}

ssize_t write(int descriptor, const void* bytes, size_t size) {
    DiskRecorder* recorder = DiskRecorder::active();
    if (!recorder || !recorder->knows(descriptor)) return syscall(SYS_write, descriptor, bytes, size);
    if (fails(*recorder)) return -1;
    return done(syscall(SYS_write, descriptor, bytes, size),
                [&] { recorder->wrote(descriptor, std::string(static_cast<const char*>(bytes), size)); });
}

int fsync(int descriptor) {
    DiskRecorder* recorder = DiskRecorder::active();
    if (!recorder || !(recorder->knows(descriptor) || recorder->is_folder(descriptor)))
        return static_cast<int>(syscall(SYS_fsync, descriptor));
    if (fails(*recorder)) return -1;
    recorder->flushed(descriptor);
    return 0;
}

int close(int descriptor) {
    if (DiskRecorder* recorder = DiskRecorder::active()) recorder->closed(descriptor);
    return static_cast<int>(syscall(SYS_close, descriptor));
}

int link(const char* from, const char* to) noexcept {
    DiskRecorder* recorder = DiskRecorder::active();
    if (!recorder || !recorder->is_inside(from))
        return static_cast<int>(syscall(SYS_linkat, AT_FDCWD, from, AT_FDCWD, to, 0));
    if (fails(*recorder)) return -1;
    return static_cast<int>(
        done(syscall(SYS_linkat, AT_FDCWD, from, AT_FDCWD, to, 0), [&] { recorder->linked(from, to); }));
}

int rename(const char* from, const char* to) noexcept {
    DiskRecorder* recorder = DiskRecorder::active();
    if (!recorder || !recorder->is_inside(from))
        return static_cast<int>(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
    if (fails(*recorder)) return -1;
    return static_cast<int>(
        done(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0), [&] { recorder->renamed(from, to); }));
}

int unlink(const char* path) noexcept {
    DiskRecorder* recorder = DiskRecorder::active();
    if (!recorder || !recorder->is_inside(path))
        return static_cast<int>(syscall(SYS_unlinkat, AT_FDCWD, path, 0));
    if (fails(*recorder)) return -1;
    return static_cast<int>(done(syscall(SYS_unlinkat, AT_FDCWD, path, 0), [&] { recorder->removed(path); }));
}

}  // extern "C"
