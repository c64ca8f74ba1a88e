#include "platform/system/checked_file.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <memory>
#include <xxhash.h>
#include <zstd.h>

#include "platform/system/atomic_file.hpp"
#include "platform/system/error.hpp"
#include "platform/system/log.hpp"

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
constexpr std::size_t growth_bytes = 1 << 20;

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

/// Grows with what there is, not with what is claimed.
std::string decompress(std::string_view packed, std::uint64_t content_bytes) {
    const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(), ZSTD_freeDCtx);
    std::string content;
    ZSTD_inBuffer in{packed.data(), packed.size(), 0};
    std::size_t left = 1;
    while (left != 0 && content.size() < content_bytes) {
        const std::size_t before = content.size();
        content.resize(std::min<std::size_t>(content_bytes, before + std::max(growth_bytes, before / 2)));
        ZSTD_outBuffer out{content.data() + before, content.size() - before, 0};
        left = ZSTD_decompressStream(context.get(), &out, &in);
        content.resize(before + out.pos);
        if (ZSTD_isError(left) != 0 || (out.pos == 0 && in.pos == in.size)) return {};
    }
    return content;
}

std::string pack(const std::filesystem::path& path, const FileFormat& format, std::string_view content) {
    const std::string packed = compress(content, path);
    Header header{format.magic, format.version, 0, content.size(), packed.size(), 0};
    header.checksum = checksum_of(header, packed);
    std::string bytes(sizeof header, '\0');
    std::memcpy(bytes.data(), &header, sizeof header);
    return bytes + packed;
}

std::string read_this_file(const std::filesystem::path& path, const FileFormat& format) {
    std::ifstream file(path, std::ios::binary);
    std::error_code none;
    if (!file || !std::filesystem::is_regular_file(path, none))
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
    std::string content = decompress(packed, header.content_bytes);
    if (content.size() != header.content_bytes)
        refuse(path, fmt::format("is damaged (compression): take a new {}", format.name));
    return content;
}

/// Whatever its version: an older program may want it again.
bool is_whole(const std::filesystem::path& path, const FileFormat& format) {
    std::ifstream file(path, std::ios::binary);
    Header header{};
    if (!file.read(reinterpret_cast<char*>(&header), sizeof header) || header.magic != format.magic)
        return false;
    try {
        return checksum_of(header, read_packed(file, header, path, format)) == header.checksum;
    } catch (const Error&) {
        return false;
    }
}

Previous what_becomes_of_previous(const std::filesystem::path& path, const FileFormat& format) {
    std::error_code none;
    if (!std::filesystem::exists(path, none)) return Previous::removed;
    return is_whole(path, format) ? Previous::kept : Previous::untouched;
}

}  // namespace

void write_checked_file(const std::filesystem::path& path, const FileFormat& format,
                        std::string_view content) {
    write_file_atomically(path, pack(path, format, content), what_becomes_of_previous(path, format));
}

void write_checked_cache(const std::filesystem::path& path, const FileFormat& format,
                         std::string_view content) {
    write_file_atomically(path, pack(path, format, content));
}

std::string read_checked_file(const std::filesystem::path& path, const FileFormat& format) {
    try {
        return read_this_file(path, format);
    } catch (const Error& damage) {
        if (damage.status() != ExitStatus::bad_data) throw;
        try {
            std::string before = read_this_file(previous_of(path), format);
            log_warning("{}; going on with the {} before it", damage.what(), format.name);
            return before;
        } catch (const Error&) {
            throw damage;
        }
    }
}

}  // namespace touchstone
