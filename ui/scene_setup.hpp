#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "platform/display/picture.hpp"
#include "ui/mesh_model.hpp"

namespace touchstone {

/// Pictures one by one. Alpha is not looked at.
struct PictureStream {
    int count = 0;                                 ///< at most so many
    std::function<std::optional<Picture>()> next;  ///< none after the last
};

/// Between the name of the table's painting and that of an area, in the name of the file of that one's.
inline const std::string area_painting_suffix = ".of-";

/// What scenes are made with.
struct SceneSetup {
    std::shared_ptr<const MeshModel> model;      ///< that stands in the scene mirror; null: its own
    std::string painting_file;                   ///< empty: the painting is not kept
    std::string photo_folder;                    ///< for people to read; may be empty
    std::function<PictureStream()> open_photos;  ///< may be empty: no pictures
};

}  // namespace touchstone
