#pragma once

#include <filesystem>

#include "platform/image/image.hpp"
#include "ui/scene_setup.hpp"

namespace touchstone {

/// More than these are too many for a table.
inline constexpr std::size_t most_photos = 24;
/// Of the longer side; larger ones are made smaller.
inline constexpr int photo_side_px = 640;

/// The PNG and JPEG files of a folder, by name. What cannot be read is skipped; one warning names the first.
/// A missing folder gives none and a warning.
PictureStream open_photo_folder(const std::filesystem::path& folder);

/// No longer than `most_px` on its longer side, each pixel the mean of those it stands for; on white where it
/// was transparent.
Picture to_photo(const Image8& image, int most_px);

}  // namespace touchstone
