#include "platform/image/png_file.hpp"

#include <bit>
#include <csetjmp>
#include <cstring>
#include <png.h>
#include <stdexcept>
#include <string>

#include "platform/image/open_file.hpp"

namespace touchstone {
namespace {

constexpr int zlib_level = 1;
constexpr png_uint_32 largest_side_px = 16384;
/// Of pixels that a byte can hold: deflate packs 1032 bytes into one, and eight pixels may be a byte.
constexpr std::uint64_t most_pixels_per_byte = 8 * 1032;

struct Message {
    char text[160] = "damaged";
};

// libpng is C and reports errors by longjmp: nothing with a destructor may live between setjmp and the calls
// it covers.
void keep_error(png_structp png, png_const_charp text) {
    auto* message = static_cast<Message*>(png_get_error_ptr(png));
    std::snprintf(message->text, sizeof message->text, "%s", text);
    png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

struct PngReader {
    Message message;
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &message, keep_error, ignore_warning);
    png_infop info = png_create_info_struct(png);
    PngReader() = default;
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;
    ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
};

struct PngWriter {
    Message message;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &message, keep_error, ignore_warning);
    png_infop info = png_create_info_struct(png);
    PngWriter() = default;
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;
    ~PngWriter() { png_destroy_write_struct(&png, &info); }
};

struct PngHeader {
    int width_px = 0, height_px = 0, bit_depth = 0, color_type = 0;
};

bool read_header(PngReader& reader, std::FILE* file, PngHeader& header) {
    if (setjmp(png_jmpbuf(reader.png))) return false;
    png_init_io(reader.png, file);
    png_set_user_limits(reader.png, largest_side_px, largest_side_px);
    png_read_info(reader.png, reader.info);
    header.width_px = static_cast<int>(png_get_image_width(reader.png, reader.info));
    header.height_px = static_cast<int>(png_get_image_height(reader.png, reader.info));
    header.bit_depth = png_get_bit_depth(reader.png, reader.info);
    header.color_type = png_get_color_type(reader.png, reader.info);
    return true;
}

/// Widens palettes and small bit depths; gray keeps one channel, gray with alpha becomes RGBA.
bool expand_to_8_bit(PngReader& reader, int& channels) {
    if (setjmp(png_jmpbuf(reader.png))) return false;
    png_set_expand(reader.png);
    if (png_get_color_type(reader.png, reader.info) == PNG_COLOR_TYPE_GRAY_ALPHA)
        png_set_gray_to_rgb(reader.png);
    png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);
    channels = png_get_channels(reader.png, reader.info);
    return true;
}

bool keep_16_bit(PngReader& reader) {
    if (setjmp(png_jmpbuf(reader.png))) return false;
    if constexpr (std::endian::native == std::endian::little) png_set_swap(reader.png);
    png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);
    return true;
}

bool read_pixels(PngReader& reader, png_bytep* rows) {
    if (setjmp(png_jmpbuf(reader.png))) return false;
    png_read_image(reader.png, rows);
    png_read_end(reader.png, nullptr);
    return true;
}

std::vector<png_bytep> row_pointers(png_bytep pixels, int height_px, std::size_t row_bytes) {
    std::vector<png_bytep> rows(static_cast<std::size_t>(height_px));
    for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = pixels + y * row_bytes;
    return rows;
}

[[noreturn]] void fail_read(const std::filesystem::path& path, const char* reason) {
    throw Error(ExitStatus::bad_data, fmt::format("cannot read {} as PNG: {}", path.string(), reason));
}

PngHeader open_png(PngReader& reader, std::FILE* file, const std::filesystem::path& path) {
    PngHeader header;
    if (!read_header(reader, file, header)) fail_read(path, reader.message.text);
    if (const char* lie = size_problem(path, static_cast<std::uint64_t>(header.width_px),
                                       static_cast<std::uint64_t>(header.height_px), most_pixels_per_byte))
        fail_read(path, lie);
    return header;
}

struct Layout {
    int width_px, height_px, color_type, bit_depth;
};

bool write_pixels(PngWriter& writer, std::FILE* file, const Layout& layout, png_bytep* rows) {
    if (setjmp(png_jmpbuf(writer.png))) return false;
    png_init_io(writer.png, file);
    png_set_compression_level(writer.png, zlib_level);
    const bool mask = layout.color_type == PNG_COLOR_TYPE_GRAY && layout.bit_depth == 8;
    png_set_filter(writer.png, PNG_FILTER_TYPE_BASE, mask ? PNG_FILTER_NONE : PNG_FILTER_SUB);
    png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(layout.width_px),
                 static_cast<png_uint_32>(layout.height_px), layout.bit_depth, layout.color_type,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
    png_write_info(writer.png, writer.info);
    if (layout.bit_depth == 16 && std::endian::native == std::endian::little) png_set_swap(writer.png);
    png_write_image(writer.png, rows);
    png_write_end(writer.png, nullptr);
    return true;
}

void write_file(const std::filesystem::path& path, const Layout& layout, const void* pixels,
                std::size_t row_bytes) {
    // png_write_image takes non-const rows for historic reasons; it does not change them.
    auto* bytes = static_cast<png_bytep>(const_cast<void*>(pixels));
    auto rows = row_pointers(bytes, layout.height_px, row_bytes);
    FilePtr file = open_file(path, "wb", ExitStatus::io_error);
    PngWriter writer;
    const bool written = write_pixels(writer, file.get(), layout, rows.data());
    const bool closed = std::fclose(file.release()) == 0;
    if (!written || !closed) {
        const char* reason = written ? std::strerror(errno) : writer.message.text;
        throw Error(ExitStatus::io_error, fmt::format("cannot write {}: {}", path.string(), reason));
    }
}

int png_color_type(int channels) {
    switch (channels) {
        case 1:
            return PNG_COLOR_TYPE_GRAY;
        case 3:
            return PNG_COLOR_TYPE_RGB;
        case 4:
            return PNG_COLOR_TYPE_RGB_ALPHA;
        default:
            throw std::invalid_argument("write_png: a picture has 1, 3 or 4 channels");
    }
}

std::size_t pixel_count(int width_px, int height_px) {
    if (width_px <= 0 || height_px <= 0) throw std::invalid_argument("write_png: empty picture");
    return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
}

}  // namespace

Image16 read_png_16(const std::filesystem::path& path) {
    FilePtr file = open_file(path, "rb", ExitStatus::no_input);
    PngReader reader;
    const PngHeader header = open_png(reader, file.get(), path);
    if (header.bit_depth != 16 || header.color_type != PNG_COLOR_TYPE_GRAY) {
        fail_read(path, fmt::format("a depth picture is 16 bit gray, this one has {} bit and {} channels",
                                    header.bit_depth, png_get_channels(reader.png, reader.info))
                            .c_str());
    }
    if (!keep_16_bit(reader)) fail_read(path, reader.message.text);
    Image16 image{header.width_px, header.height_px, {}};
    const std::size_t width = static_cast<std::size_t>(header.width_px);
    image.pixels.resize(width * static_cast<std::size_t>(header.height_px));
    auto rows = row_pointers(reinterpret_cast<png_bytep>(image.pixels.data()), header.height_px, 2 * width);
    if (!read_pixels(reader, rows.data())) fail_read(path, reader.message.text);
    return image;
}

Image8 read_png_8(const std::filesystem::path& path) {
    FilePtr file = open_file(path, "rb", ExitStatus::no_input);
    PngReader reader;
    const PngHeader header = open_png(reader, file.get(), path);
    if (header.bit_depth == 16) fail_read(path, "it has 16 bit a channel where 8 are expected");
    Image8 image{header.width_px, header.height_px, 0, {}};
    if (!expand_to_8_bit(reader, image.channels)) fail_read(path, reader.message.text);
    const std::size_t row_bytes = static_cast<std::size_t>(header.width_px * image.channels);
    image.pixels.resize(row_bytes * static_cast<std::size_t>(header.height_px));
    auto rows = row_pointers(image.pixels.data(), header.height_px, row_bytes);
    if (!read_pixels(reader, rows.data())) fail_read(path, reader.message.text);
    return image;
}

void write_png(const std::filesystem::path& path, const Image8& image) {
    const Layout layout{image.width_px, image.height_px, png_color_type(image.channels), 8};
    const std::size_t bytes =
        pixel_count(image.width_px, image.height_px) * static_cast<std::size_t>(image.channels);
    if (image.pixels.size() != bytes) throw std::invalid_argument("write_png: pixels do not fit the size");
    write_file(path, layout, image.pixels.data(), bytes / static_cast<std::size_t>(image.height_px));
}

void write_png(const std::filesystem::path& path, const Image16& image) {
    const std::size_t count = pixel_count(image.width_px, image.height_px);
    if (image.pixels.size() != count) throw std::invalid_argument("write_png: pixels do not fit the size");
    write_file(path, {image.width_px, image.height_px, PNG_COLOR_TYPE_GRAY, 16}, image.pixels.data(),
               2 * static_cast<std::size_t>(image.width_px));
}

}  // namespace touchstone
