#include <cstdio>

#include "platform/image/jpeg_file.hpp"
// Needs size_t and FILE from the line above.
#include <jpeglib.h>

#include "tests/fuzz/support.hpp"

namespace touchstone::fuzz {
namespace {

const MemoryFolder folder;

std::string some_jpeg(bool progressive, int components) {
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* memory = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &memory, &size);
    jpeg.image_width = 24;
    jpeg.image_height = 16;
    jpeg.input_components = components;
    jpeg.in_color_space = components == 3 ? JCS_RGB : JCS_GRAYSCALE;
    jpeg_set_defaults(&jpeg);
    if (progressive) jpeg_simple_progression(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    std::vector<unsigned char> line(72);
    while (jpeg.next_scanline < jpeg.image_height) {
        for (std::size_t i = 0; i < line.size(); ++i)
            line[i] = static_cast<unsigned char>(i * 3 + jpeg.next_scanline * 7);
        JSAMPROW row = line.data();
        jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    std::string bytes(reinterpret_cast<const char*>(memory), size);
    jpeg_destroy_compress(&jpeg);
    std::free(memory);
    return bytes;
}

}  // namespace

std::vector<std::string> seeds() {
    return {some_jpeg(false, 3), some_jpeg(true, 3), some_jpeg(false, 1), some_jpeg(true, 1)};
}

}  // namespace touchstone::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace touchstone::fuzz;
    const std::filesystem::path file = folder.put("tested.jpg", text_of(bytes, size));
    must_answer([&] { (void)touchstone::read_jpeg_rgb(file); });
    return 0;
}
