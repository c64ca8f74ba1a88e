#include "app/frame_outputs.hpp"

#include <fmt/format.h>

#include "platform/image/png_file.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

PictureFolder::PictureFolder(const std::string& path) : path_(path) {
    std::error_code failure;
    std::filesystem::create_directories(path_, failure);
    if (failure)
        throw Error(ExitStatus::io_error, "folder " + path + " cannot be made: " + failure.message());
}

void PictureFolder::write_map(int frame, const std::string& what, int width_px, int height_px,
                              std::vector<std::uint8_t> map) const {
    write_png(path_ / fmt::format("frame-{:06}.{}.png", frame, what),
              Image8{width_px, height_px, 1, std::move(map)});
}

void PictureFolder::write_shot(int frame, Picture picture) const {
    write_png(path_ / fmt::format("frame-{:06}.png", frame),
              Image8{picture.width_px, picture.height_px, 4, std::move(picture.rgba)});
}

}  // namespace touchstone
