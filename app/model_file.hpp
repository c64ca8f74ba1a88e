#pragma once

#include <filesystem>
#include <memory>

#include "ui/mesh_model.hpp"

namespace touchstone {

/// A mesh file as a model that stands upright: +y is up, as in glTF. Throws Error as read_mesh_file.
std::shared_ptr<const MeshModel> load_model(const std::filesystem::path& path);

}  // namespace touchstone
