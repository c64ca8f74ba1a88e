#include "platform/image/jpeg_file.hpp"

#include <csetjmp>
#include <cstdio>

#include "platform/image/open_file.hpp"

// These two need size_t and FILE from the lines above.
#include <jerror.h>
#include <jpeglib.h>

namespace touchstone {
namespace {

constexpr int most_scans = 200;
/// Of pixels that a byte can hold: a block of 64 takes a bit at least.
constexpr std::uint64_t most_pixels_per_byte = 1024;

// libjpeg is C and reports errors by longjmp: nothing with a destructor may live between setjmp and the calls
// it covers.
struct JpegErrors {
    jpeg_error_mgr manager{};
    std::jmp_buf jump{};
    char text[JMSG_LENGTH_MAX] = "damaged";
};

void keep_error(j_common_ptr jpeg) {
    auto* errors = reinterpret_cast<JpegErrors*>(jpeg->err);
    errors->manager.format_message(jpeg, errors->text);
    std::longjmp(errors->jump, 1);
}

/// A file cut short is only a warning to libjpeg (it paints the rest gray); to us it is damaged.
void check_warning(j_common_ptr jpeg, int level) {
    if (level < 0 && jpeg->err->msg_code == JWRN_JPEG_EOF) keep_error(jpeg);
}

/// A small file may ask to go through a large picture thousands of times.
void count_scans(j_common_ptr jpeg) {
    if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number <= most_scans) return;
    auto* errors = reinterpret_cast<JpegErrors*>(jpeg->err);
    std::snprintf(errors->text, sizeof errors->text, "it has more than %d scans", most_scans);
    std::longjmp(errors->jump, 1);
}

struct JpegReader {
    jpeg_decompress_struct jpeg{};
    jpeg_progress_mgr progress{};
    JpegErrors errors;
    JpegReader() {
        progress.progress_monitor = count_scans;
        jpeg.err = jpeg_std_error(&errors.manager);
        errors.manager.error_exit = keep_error;
        errors.manager.emit_message = check_warning;
    }
    JpegReader(const JpegReader&) = delete;
    JpegReader& operator=(const JpegReader&) = delete;
    ~JpegReader() { jpeg_destroy_decompress(&jpeg); }
};

bool start(JpegReader& reader, std::FILE* file) {
    if (setjmp(reader.errors.jump)) return false;
    jpeg_create_decompress(&reader.jpeg);
    reader.jpeg.progress = &reader.progress;
    jpeg_stdio_src(&reader.jpeg, file);
    jpeg_read_header(&reader.jpeg, TRUE);
    return true;
}

bool start_pixels(JpegReader& reader) {
    if (setjmp(reader.errors.jump)) return false;
    reader.jpeg.out_color_space = JCS_RGB;
    jpeg_start_decompress(&reader.jpeg);
    return true;
}

bool read_pixels(JpegReader& reader, std::uint8_t* pixels, std::size_t row_bytes) {
    if (setjmp(reader.errors.jump)) return false;
    while (reader.jpeg.output_scanline < reader.jpeg.output_height) {
        JSAMPROW row = pixels + reader.jpeg.output_scanline * row_bytes;
        jpeg_read_scanlines(&reader.jpeg, &row, 1);
    }
    jpeg_finish_decompress(&reader.jpeg);
    return true;
}

[[noreturn]] void fail_read(const std::filesystem::path& path, const char* reason) {
    throw Error(ExitStatus::bad_data, fmt::format("cannot read {} as JPEG: {}", path.string(), reason));
}

}  // namespace

Image8 read_jpeg_rgb(const std::filesystem::path& path) {
    FilePtr file = open_file(path, "rb", ExitStatus::no_input);
    JpegReader reader;
    if (!start(reader, file.get())) fail_read(path, reader.errors.text);
    if (const char* lie =
            size_problem(path, reader.jpeg.image_width, reader.jpeg.image_height, most_pixels_per_byte))
        fail_read(path, lie);
    if (!start_pixels(reader)) fail_read(path, reader.errors.text);
    Image8 image{
        static_cast<int>(reader.jpeg.output_width), static_cast<int>(reader.jpeg.output_height), 3, {}};
    const std::size_t row_bytes = 3 * static_cast<std::size_t>(image.width_px);
    image.pixels.resize(row_bytes * static_cast<std::size_t>(image.height_px));
    if (!read_pixels(reader, image.pixels.data(), row_bytes)) fail_read(path, reader.errors.text);
    return image;
}

}  // namespace touchstone
