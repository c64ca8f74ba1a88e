#include "platform/system/projected_picture.hpp"

#include <atomic>
#include <bit>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/core.h>
#include <string_view>
#include <sys/mman.h>
#include <sys/stat.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

using Word = std::atomic<std::uint32_t>;
static_assert(Word::is_always_lock_free && sizeof(Word) == 4, "the words are shared between mappings");

constexpr std::uint64_t magic = 0x31545049'4a4f5250U;  // "PROJPIT1"

/// As it lies in the shared memory, with one word for each pixel behind it. Zero in the beginning.
struct Header {
    std::atomic<std::uint64_t> magic;
    std::atomic<std::uint64_t> sequence;  ///< odd while a picture is being written
    Word width_px, height_px, has_aim, aim_x, aim_y, unused;
};
static_assert(sizeof(Header) % sizeof(Word) == 0);

[[noreturn]] void fail(const std::string& name, std::string_view step, int code) {
    throw Error(ExitStatus::io_error,
                fmt::format("cannot share the projected picture {}: {}: {}; look at the space in /dev/shm",
                            name, step, std::generic_category().message(code)));
}

struct Descriptor {
    explicit Descriptor(int opened) : fd(opened) {}
    ~Descriptor() {
        if (fd >= 0) ::close(fd);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    const int fd;
};

/// The file that the name means now; no size where there is none.
struct stat status_of(int fd) {
    struct stat status = {};
    if (fd < 0 || ::fstat(fd, &status) != 0) status = {};
    return status;
}

/// Both sides see all of the file; only the writer may write.
class SharedMemory {
  public:
    SharedMemory(int fd, bool writable) : status_(status_of(fd)) {
        const auto bytes = static_cast<std::size_t>(status_.st_size);
        if (bytes < sizeof(Header)) return;
        void* const at =
            ::mmap(nullptr, bytes, writable ? PROT_READ | PROT_WRITE : PROT_READ, MAP_SHARED, fd, 0);
        if (at != MAP_FAILED) header_ = static_cast<Header*>(at);
    }
    ~SharedMemory() {
        if (header_ != nullptr) ::munmap(header_, static_cast<std::size_t>(status_.st_size));
    }
    SharedMemory(const SharedMemory&) = delete;
    SharedMemory& operator=(const SharedMemory&) = delete;

    /// Null where the system gave none.
    Header* header() const { return header_; }
    Word* pixels() const { return reinterpret_cast<Word*>(header_ + 1); }
    std::size_t most_pixels() const {
        return (static_cast<std::size_t>(status_.st_size) - sizeof(Header)) / sizeof(Word);
    }
    /// Of the same file, with the same length. A mapped file keeps its number to itself.
    bool is(const struct stat& other) const {
        return status_.st_dev == other.st_dev && status_.st_ino == other.st_ino &&
               status_.st_size == other.st_size;
    }

  private:
    struct stat status_;
    Header* header_ = nullptr;
};

/// What a crash has left under the name is not ours to go on with: a reader may still look at it.
std::unique_ptr<SharedMemory> create_memory(const std::string& name, std::size_t most_pixels) {
    ::shm_unlink(name.c_str());
    const Descriptor file(::shm_open(name.c_str(), O_CREAT | O_EXCL | O_RDWR, 0600));
    if (file.fd < 0) fail(name, "shm_open", errno);
    // Not ftruncate: where the space is missing, that would fail only when the picture is written, by SIGBUS.
    const auto bytes = static_cast<off_t>(sizeof(Header) + sizeof(Word) * most_pixels);
    if (const int code = ::posix_fallocate(file.fd, 0, bytes); code != 0) {
        ::shm_unlink(name.c_str());
        fail(name, "allocate", code);
    }
    auto memory = std::make_unique<SharedMemory>(file.fd, true);
    if (memory->header() == nullptr) {
        ::shm_unlink(name.c_str());
        fail(name, "map", ENOMEM);
    }
    return memory;
}

Descriptor open_memory(const std::string& name) { return Descriptor(::shm_open(name.c_str(), O_RDONLY, 0)); }

// A sequence lock without fences, which the thread sanitizer does not know: what is written releases the odd
// number before it, and what is read acquires before the number is read again.

void store_pixels(Word* to, std::span<const std::uint8_t> rgba) {
    for (std::size_t i = 0; i < rgba.size() / 4; ++i) {
        std::uint32_t pixel;
        std::memcpy(&pixel, rgba.data() + 4 * i, 4);
        to[i].store(pixel, std::memory_order_release);
    }
}

void load_pixels(const Word* from, std::vector<std::uint8_t>& rgba) {
    for (std::size_t i = 0; i < rgba.size() / 4; ++i) {
        const std::uint32_t pixel = from[i].load(std::memory_order_acquire);
        std::memcpy(rgba.data() + 4 * i, &pixel, 4);
    }
}

/// False where the writer was at work meanwhile: what was read is then of two pictures.
bool load_whole(const SharedMemory& memory, std::uint64_t& sequence, ProjectedPicture& picture) {
    const Header& header = *memory.header();
    sequence = header.sequence.load(std::memory_order_acquire);
    if (sequence % 2 != 0) return false;
    const std::size_t width = header.width_px.load(std::memory_order_acquire);
    const std::size_t height = header.height_px.load(std::memory_order_acquire);
    if (width * height > memory.most_pixels()) return false;
    picture.width_px = static_cast<int>(width);
    picture.height_px = static_cast<int>(height);
    picture.rgba.resize(4 * width * height);
    load_pixels(memory.pixels(), picture.rgba);
    picture.aim_px.reset();
    if (header.has_aim.load(std::memory_order_acquire) != 0)
        picture.aim_px = {std::bit_cast<float>(header.aim_x.load(std::memory_order_acquire)),
                          std::bit_cast<float>(header.aim_y.load(std::memory_order_acquire))};
    return header.sequence.load(std::memory_order_relaxed) == sequence;
}

}  // namespace

std::string projected_picture_name() { return fmt::format("/touchstone-projected-{}", ::getpid()); }

struct ProjectedPictureWriter::Mapping {
    std::string name;
    int width_px, height_px;  ///< of the largest picture
    std::unique_ptr<SharedMemory> memory;
};

ProjectedPictureWriter::ProjectedPictureWriter(const std::string& name, int width_px, int height_px) {
    const std::size_t most_pixels = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
    mapping_ = std::make_unique<Mapping>(name, width_px, height_px, create_memory(name, most_pixels));
    mapping_->memory->header()->magic.store(magic, std::memory_order_release);
}

ProjectedPictureWriter::~ProjectedPictureWriter() {
    // Another writer may have taken the name over.
    if (mapping_->memory->is(status_of(open_memory(mapping_->name).fd))) ::shm_unlink(mapping_->name.c_str());
}

void ProjectedPictureWriter::show(std::span<const std::uint8_t> rgba, int width_px, int height_px,
                                  std::optional<std::array<float, 2>> aim_px) {
    if (width_px > mapping_->width_px || height_px > mapping_->height_px)
        throw Error(ExitStatus::bad_data,
                    fmt::format("a projected picture of {}x{} pixels is larger than the {}x{} that were "
                                "announced",
                                width_px, height_px, mapping_->width_px, mapping_->height_px));
    if (width_px < 1 || height_px < 1 ||
        rgba.size() != 4 * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px))
        throw Error(ExitStatus::bad_data, fmt::format("a projected picture of {}x{} pixels has {} bytes",
                                                      width_px, height_px, rgba.size()));
    Header& header = *mapping_->memory->header();
    const std::uint64_t sequence = header.sequence.load(std::memory_order_relaxed);
    header.sequence.store(sequence + 1, std::memory_order_relaxed);
    header.width_px.store(static_cast<std::uint32_t>(width_px), std::memory_order_release);
    header.height_px.store(static_cast<std::uint32_t>(height_px), std::memory_order_release);
    header.has_aim.store(aim_px ? 1 : 0, std::memory_order_release);
    if (aim_px) {
        header.aim_x.store(std::bit_cast<std::uint32_t>((*aim_px)[0]), std::memory_order_release);
        header.aim_y.store(std::bit_cast<std::uint32_t>((*aim_px)[1]), std::memory_order_release);
    }
    store_pixels(mapping_->memory->pixels(), rgba);
    header.sequence.store(sequence + 2, std::memory_order_release);
}

struct ProjectedPictureReader::Mapping {
    explicit Mapping(int fd) : memory(fd, false) {}
    bool is_ready() const {
        return memory.header() != nullptr && memory.header()->magic.load(std::memory_order_acquire) == magic;
    }

    SharedMemory memory;
    std::uint64_t sequence = 0;  ///< of the picture that was read last; 0: none
    ProjectedPicture loading;
};

ProjectedPictureReader::ProjectedPictureReader(std::string name) : name_(std::move(name)) {}

ProjectedPictureReader::~ProjectedPictureReader() = default;

const ProjectedPicture* ProjectedPictureReader::latest() {
    const Descriptor file = open_memory(name_);
    const struct stat status = status_of(file.fd);
    if (mapping_ && !mapping_->memory.is(status)) mapping_.reset();
    if (!mapping_ && status.st_size > 0) mapping_ = std::make_unique<Mapping>(file.fd);
    if (!mapping_ || !mapping_->is_ready()) {
        mapping_.reset();
        return nullptr;
    }
    // A writer that was killed in the middle of a picture never ends it.
    constexpr int most_tries = 100;
    for (int i = 0; i < most_tries; ++i) {
        const std::uint64_t newest = mapping_->memory.header()->sequence.load(std::memory_order_acquire);
        if (newest == mapping_->sequence) break;
        std::uint64_t sequence = 0;
        if (load_whole(mapping_->memory, sequence, mapping_->loading)) {
            mapping_->sequence = sequence;
            mapping_->loading.version = picture_.version + 1;
            std::swap(picture_, mapping_->loading);
            break;
        }
        std::this_thread::yield();
    }
    return mapping_->sequence == 0 ? nullptr : &picture_;
}

}  // namespace touchstone
