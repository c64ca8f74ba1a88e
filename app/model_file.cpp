#include "app/model_file.hpp"

#include <utility>

#include "platform/mesh/mesh_file.hpp"

namespace touchstone {

std::shared_ptr<const MeshModel> load_model(const std::filesystem::path& path) {
    MeshFile file = read_mesh_file(path, MeshDetail::look);
    MeshModel model;
    for (std::size_t i = 0; i < file.positions.size(); ++i)
        model.corners.push_back({file.positions[i], file.normals[i], file.colors[i]});
    model.triangles = std::move(file.triangles);
    return std::make_shared<const MeshModel>(standing(std::move(model)));
}

}  // namespace touchstone
