#include "platform/image/png_file.hpp"
#include "tests/fuzz/support.hpp"

namespace touchstone::fuzz {
namespace {

const MemoryFolder folder;

std::uint32_t crc_of(std::string_view bytes) {
    std::uint32_t crc = 0xffffffffu;
    for (const char byte : bytes) {
        crc ^= static_cast<std::uint8_t>(byte);
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (0xedb88320u & (0u - (crc & 1u)));
    }
    return ~crc;
}

std::uint32_t big_endian(std::string_view bytes) {
    std::uint32_t value = 0;
    for (const char byte : bytes.substr(0, 4)) value = value << 8 | static_cast<std::uint8_t>(byte);
    return value;
}

/// With checksums that are right, as far as its chunks can be followed.
std::string sealed(std::string png) {
    for (std::size_t at = 8; at + 12 <= png.size();) {
        const std::size_t length = big_endian(std::string_view(png).substr(at));
        if (length > png.size() - at - 12) break;
        const std::uint32_t crc = crc_of(std::string_view(png).substr(at + 4, length + 4));
        for (std::size_t i = 0; i < 4; ++i) png[at + 8 + length + i] = static_cast<char>(crc >> (24 - 8 * i));
        at += length + 12;
    }
    return png;
}

}  // namespace

std::vector<std::string> seeds() {
    const Image16 depth{16, 12, std::vector<std::uint16_t>(192, 1000)};
    write_png(folder / "depth", depth);
    for (const int channels : {1, 3, 4}) {
        const auto count = static_cast<std::size_t>(channels);
        write_png(folder / std::to_string(channels),
                  Image8{16, 12, channels, std::vector<std::uint8_t>(192 * count, 9)});
    }
    std::vector<std::string> all;
    for (const char* name : {"depth", "1", "3", "4"}) {
        all.push_back(marked('s', folder.bytes(name)));
        all.push_back(marked('f', folder.bytes(name)));
    }
    return all;
}

}  // namespace touchstone::fuzz

/// The first byte is s where the checksums shall be right.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace touchstone::fuzz;
    if (size == 0) return 0;
    const std::string rest(text_of(bytes, size).substr(1));
    const std::filesystem::path file = folder.put("tested.png", bytes[0] == 's' ? sealed(rest) : rest);
    must_answer([&] { (void)touchstone::read_png_16(file); });
    must_answer([&] { (void)touchstone::read_png_8(file); });
    return 0;
}
