#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace touchstone::test {

/// What a program asked of the disk. `file` tells files apart whatever they are called.
struct DiskCall {
    enum class Kind { create, truncate, write, flush, link, rename, remove, flush_folder };
    Kind kind;
    int file = -1;
    std::string name, other;  ///< within the folder; `other` is the new name of link and rename
    std::string bytes;        ///< of a write
};

/// Records what this process does to the files of one folder (not those below it) by open, write, fsync,
/// link, rename and unlink, and carries it out. One at a time, one thread.
class DiskRecorder {
  public:
    explicit DiskRecorder(std::filesystem::path folder);
    ~DiskRecorder();
    DiskRecorder(const DiskRecorder&) = delete;
    DiskRecorder& operator=(const DiskRecorder&) = delete;

    /// The n-th call from now on (0: the next) fails with this code, and is not recorded.
    void fail_at(int call, int code);
    /// Whether it did.
    bool has_failed() const { return has_failed_; }
    const std::vector<DiskCall>& calls() const { return calls_; }

    // For the functions that stand in for the system's.
    static DiskRecorder* active();
    bool is_inside(const std::string& path) const;
    /// The code of the failure that is due.
    std::optional<int> failure();
    void opened(int descriptor, const std::string& path, bool existed, bool truncates);
    void opened_folder(int descriptor) { folder_descriptor_ = descriptor; }
    bool is_folder(int descriptor) const { return descriptor == folder_descriptor_; }
    bool knows(int descriptor) const { return open_.contains(descriptor); }
    void wrote(int descriptor, std::string bytes);
    void flushed(int descriptor);
    void closed(int descriptor);
    void linked(const std::string& from, const std::string& to);
    void renamed(const std::string& from, const std::string& to);
    void removed(const std::string& path);

  private:
    int file_named(const std::string& name);

    std::filesystem::path folder_;
    std::vector<DiskCall> calls_;
    std::map<std::string, int> names_;
    std::map<int, int> open_;
    int files_ = 0, folder_descriptor_ = -1, calls_until_failure_ = -1, failure_ = 0;
    bool has_failed_ = false;
};

/// Names and contents of a folder.
using DiskContent = std::map<std::string, std::string>;

DiskContent content_of_folder(const std::filesystem::path& folder);
/// Empties the folder first.
void put_content(const std::filesystem::path& folder, const DiskContent& content);

/// What a disk may hold after the power went when `calls` had been made on `before`, all of which was on the
/// disk: what was flushed is there; what was not is there, not there, cut short, zeros or garbage, each file
/// by itself; names that were not flushed are the old or the new ones, in any mixture.
DiskContent after_power_cut(const DiskContent& before, const std::vector<DiskCall>& calls,
                            std::size_t calls_made, std::mt19937& random);

}  // namespace touchstone::test
