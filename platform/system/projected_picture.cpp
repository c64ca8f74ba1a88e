#include "platform/system/projected_picture.hpp"

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <fcntl.h>
#include <fmt/core.h>
#include <new>
#include <sys/mman.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <utility>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

constexpr std::uint32_t magic = 0x54535031;
constexpr int read_tries = 50;

/// At the start of the shared memory; the pixels follow. All but `magic` and `capacity_bytes` belongs to the
/// picture whose number is `version`: odd while it is being written.
struct Header {
    std::uint32_t magic;
    std::uint64_t capacity_bytes;
    std::atomic<std::uint64_t> version;
    std::atomic<int> width_px, height_px;
    std::atomic<bool> has_aim;
    std::atomic<float> aim_x_px, aim_y_px;
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free && std::atomic<float>::is_always_lock_free);

Error system_error(const std::string& name, const char* step) {
    return {ExitStatus::io_error,
            fmt::format("shared memory {}: {} failed ({})", name, step, std::strerror(errno))};
}

/// Mapped memory of so many bytes.
class MappedMemory {
  public:
    MappedMemory(void* address, std::size_t bytes) : address_(address), bytes_(bytes) {}
    ~MappedMemory() {
        if (address_) munmap(address_, bytes_);
    }
    MappedMemory(MappedMemory&& other) noexcept
        : address_(std::exchange(other.address_, nullptr)), bytes_(other.bytes_) {}
    MappedMemory& operator=(MappedMemory&&) = delete;
    MappedMemory(const MappedMemory&) = delete;
    MappedMemory& operator=(const MappedMemory&) = delete;

    Header& header() const { return *static_cast<Header*>(address_); }
    std::uint8_t* pixels() const { return static_cast<std::uint8_t*>(address_) + sizeof(Header); }
    std::size_t bytes() const { return bytes_; }

  private:
    void* address_;
    std::size_t bytes_;
};

}  // namespace

std::string projected_picture_name() { return fmt::format("/touchstone-projector-{}", getpid()); }

struct ProjectedPictureWriter::Mapping {
    std::string name;
    MappedMemory memory;
};

ProjectedPictureWriter::ProjectedPictureWriter(const std::string& name, int width_px, int height_px) {
    const std::size_t pixels = 4 * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
    const std::size_t bytes = sizeof(Header) + pixels;
    shm_unlink(name.c_str());  // of a process of that number that was killed
    const int file = shm_open(name.c_str(), O_RDWR | O_CREAT | O_EXCL, S_IRUSR | S_IWUSR);
    if (file < 0) throw system_error(name, "making it");
    void* address = MAP_FAILED;
    if (ftruncate(file, static_cast<off_t>(bytes)) == 0)
        address = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    const Error failure = system_error(name, "mapping it");
    close(file);
    if (address == MAP_FAILED) {
        shm_unlink(name.c_str());
        throw failure;
    }
    mapping_ = std::make_unique<Mapping>(Mapping{name, MappedMemory(address, bytes)});
    Header* const header = new (address) Header{};
    header->capacity_bytes = pixels;
    header->magic = magic;
}

ProjectedPictureWriter::~ProjectedPictureWriter() {
    mapping_->memory.header().magic = 0;  // readers that still hold it look for another one
    shm_unlink(mapping_->name.c_str());
}

void ProjectedPictureWriter::show(std::span<const std::uint8_t> rgba, int width_px, int height_px,
                                  std::optional<std::array<float, 2>> aim_px) {
    Header& header = mapping_->memory.header();
    const std::size_t bytes = 4 * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
    if (bytes != rgba.size() || bytes > header.capacity_bytes)
        throw Error(ExitStatus::io_error,
                    fmt::format("a picture of {} x {} does not fit the shared memory", width_px, height_px));
    header.version.fetch_add(1, std::memory_order_acq_rel);
    std::atomic_thread_fence(std::memory_order_release);
    header.width_px = width_px;
    header.height_px = height_px;
    header.has_aim = aim_px.has_value();
    header.aim_x_px = aim_px ? (*aim_px)[0] : 0.0F;
    header.aim_y_px = aim_px ? (*aim_px)[1] : 0.0F;
    std::memcpy(mapping_->memory.pixels(), rgba.data(), bytes);
    header.version.fetch_add(1, std::memory_order_release);
}

struct ProjectedPictureReader::Mapping {
    MappedMemory memory;
};

ProjectedPictureReader::ProjectedPictureReader(std::string name) : name_(std::move(name)) {}
ProjectedPictureReader::~ProjectedPictureReader() = default;

const ProjectedPicture* ProjectedPictureReader::latest() {
    if (mapping_ && mapping_->memory.header().magic != magic) {
        mapping_.reset();
        picture_ = {};
    }
    if (!mapping_) open();
    if (!mapping_) return nullptr;
    const Header& header = mapping_->memory.header();
    for (int attempt = 0; attempt < read_tries; ++attempt) {
        const std::uint64_t version = header.version.load(std::memory_order_acquire);
        if (version == picture_.version) break;
        if (version % 2 == 0 && copy(version)) break;
        std::this_thread::yield();
    }
    return picture_.version > 0 ? &picture_ : nullptr;
}

void ProjectedPictureReader::open() {
    const int file = shm_open(name_.c_str(), O_RDONLY, 0);
    if (file < 0) return;
    struct stat status {};
    void* address = MAP_FAILED;
    const bool is_whole = fstat(file, &status) == 0 && status.st_size > static_cast<off_t>(sizeof(Header));
    const auto bytes = static_cast<std::size_t>(is_whole ? status.st_size : 0);
    if (is_whole) address = mmap(nullptr, bytes, PROT_READ, MAP_SHARED, file, 0);
    close(file);
    if (address == MAP_FAILED) return;
    auto mapping = std::make_unique<Mapping>(Mapping{MappedMemory(address, bytes)});
    if (mapping->memory.header().magic == magic) mapping_ = std::move(mapping);
}

/// False where it was written meanwhile: the picture is then half of one and half of another.
bool ProjectedPictureReader::copy(std::uint64_t version) {
    const MappedMemory& memory = mapping_->memory;
    const Header& header = memory.header();
    next_.width_px = header.width_px;
    next_.height_px = header.height_px;
    const std::size_t bytes =
        4 * static_cast<std::size_t>(next_.width_px) * static_cast<std::size_t>(next_.height_px);
    if (bytes > memory.bytes() - sizeof(Header)) return false;
    next_.aim_px.reset();
    if (header.has_aim) next_.aim_px = std::array<float, 2>{header.aim_x_px, header.aim_y_px};
    next_.rgba.assign(memory.pixels(), memory.pixels() + bytes);
    std::atomic_thread_fence(std::memory_order_acquire);
    if (header.version.load(std::memory_order_relaxed) != version) return false;
    next_.version = version;
    std::swap(picture_, next_);
    return true;
}

}  // namespace touchstone
