#include "platform/system/checked_file.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <xxhash.h>
#include <zstd.h>

#include "platform/system/atomic_file.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

namespace {

static_assert(std::endian::native == std::endian::little, "the file is written as it lies in memory");

/// As it lies in the file.
struct Header {
    std::array<char, 8> magic;
    std::uint32_t version, zero;
    std::uint64_t content_bytes, packed_bytes, checksum;
};
static_assert(sizeof(Header) == checked_file_header_bytes);

constexpr int compression_level = 3;

std::uint64_t checksum_of(const Header& header, std::string_view packed) {
    XXH3_state_t* state = XXH3_createState();
    XXH3_64bits_reset(state);
    XXH3_64bits_update(state, &header, offsetof(Header, checksum));
    XXH3_64bits_update(state, packed.data(), packed.size());
    const std::uint64_t sum = XXH3_64bits_digest(state);
    XXH3_freeState(state);
    return sum;
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
    throw Error(ExitStatus::bad_data, path.string() + " " + why);
}

std::string compress(std::string_view content, const std::filesystem::path& path) {
    std::string packed(ZSTD_compressBound(content.size()), '\0');
    const std::size_t size =
        ZSTD_compress(packed.data(), packed.size(), content.data(), content.size(), compression_level);
    if (ZSTD_isError(size) != 0)
        throw Error(ExitStatus::io_error,
                    fmt::format("cannot write {}: compression: {}", path.string(), ZSTD_getErrorName(size)));
    packed.resize(size);
    return packed;
}

Header read_header(std::ifstream& file, const std::filesystem::path& path, const FileFormat& format) {
    Header header{};
    file.read(reinterpret_cast<char*>(&header), sizeof header);
    const auto got = static_cast<std::size_t>(file.gcount());
    if (got < header.magic.size() || header.magic != format.magic)
        refuse(path, fmt::format("is not a {} of Touchstone", format.name));
    if (got < sizeof header)
        refuse(path, fmt::format("is cut short: take a whole {} or a new one", format.name));
    if (header.version != format.version) {
        refuse(path,
               fmt::format("was written by {} version of Touchstone (format {}, read is {}): take a new {}",
                           header.version > format.version ? "a newer" : "an older", header.version,
                           format.version, format.name));
    }
    return header;
}

/// Everything behind the header.
std::string read_packed(std::ifstream& file, const Header& header, const std::filesystem::path& path,
                        const FileFormat& format) {
    std::error_code failure;
    const std::uint64_t file_bytes = std::filesystem::file_size(path, failure);
    if (failure) refuse(path, "cannot be read: " + failure.message());
    const std::uint64_t packed_bytes = file_bytes - std::min<std::uint64_t>(file_bytes, sizeof(Header));
    if (packed_bytes < header.packed_bytes)
        refuse(path, fmt::format("is cut short: take a whole {} or a new one", format.name));
    if (packed_bytes > header.packed_bytes || packed_bytes > ZSTD_compressBound(format.max_content_bytes))
        refuse(path, fmt::format("is longer than the {} in it: take a new one", format.name));
    std::string packed(packed_bytes, '\0');
    file.read(packed.data(), static_cast<std::streamsize>(packed.size()));
    if (static_cast<std::uint64_t>(file.gcount()) != packed_bytes) refuse(path, "cannot be read to its end");
    return packed;
}

}  // namespace

void write_checked_file(const std::filesystem::path& path, const FileFormat& format,
                        std::string_view content) {
    const std::string packed = compress(content, path);
    Header header{format.magic, format.version, 0, content.size(), packed.size(), 0};
    header.checksum = checksum_of(header, packed);
    std::string bytes(sizeof header, '\0');
    std::memcpy(bytes.data(), &header, sizeof header);
    write_file_atomically(path, bytes + packed);
}

std::string read_checked_file(const std::filesystem::path& path, const FileFormat& format) {
    std::ifstream file(path, std::ios::binary);
    if (!file || !std::filesystem::is_regular_file(path))
        throw Error(ExitStatus::no_input, fmt::format("{} {} cannot be opened", format.name, path.string()));
    const Header header = read_header(file, path, format);
    const std::string packed = read_packed(file, header, path, format);
    if (header.checksum != checksum_of(header, packed))
        refuse(path, fmt::format("is damaged (checksum): take a new {}", format.name));
    if (header.content_bytes > format.max_content_bytes)
        refuse(path,
               fmt::format("claims {} bytes, more than a {} can have", header.content_bytes, format.name));
    if (ZSTD_getFrameContentSize(packed.data(), packed.size()) != header.content_bytes)
        refuse(path, fmt::format("is damaged (size): take a new {}", format.name));
    std::string content(header.content_bytes, '\0');
    if (ZSTD_decompress(content.data(), content.size(), packed.data(), packed.size()) != content.size())
        refuse(path, fmt::format("is damaged (compression): take a new {}", format.name));
    return content;
}

}  // namespace touchstone
