#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "platform/display/picture.hpp"

namespace touchstone {

/// A folder of pictures named by frame, made with its parents. Throws Error{io_error}.
class PictureFolder {
  public:
    explicit PictureFolder(const std::string& path);
    /// frame-%06d.WHAT.png, 8 bit gray.
    void write_map(int frame, const std::string& what, int width_px, int height_px,
                   std::vector<std::uint8_t> map) const;
    /// frame-%06d.png, RGBA.
    void write_shot(int frame, Picture picture) const;

  private:
    std::filesystem::path path_;
};

}  // namespace touchstone
