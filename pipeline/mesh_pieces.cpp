#include <numeric>

#include "pipeline/surface_mesh.hpp"

namespace touchstone {
namespace {

/// Vertices that triangles connect have one root.
class Pieces {
  public:
    explicit Pieces(std::size_t vertices) : parent_(vertices) {
        std::iota(parent_.begin(), parent_.end(), 0U);
    }
    std::uint32_t root(std::uint32_t vertex) {
        while (parent_[vertex] != vertex) {
            parent_[vertex] = parent_[parent_[vertex]];
            vertex = parent_[vertex];
        }
        return vertex;
    }
    void connect(std::uint32_t a, std::uint32_t b) { parent_[root(a)] = root(b); }

  private:
    std::vector<std::uint32_t> parent_;
};

/// Keeps the values of vertices that stay, in their order.
template <class T>
void keep(std::vector<T>& values, const std::vector<bool>& stays) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (stays[i]) values[kept++] = values[i];
    }
    values.resize(kept);
}

void keep_vertices(SurfaceMesh& mesh, const std::vector<bool>& stays) {
    std::vector<std::uint32_t> renumbered(stays.size(), 0);
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < stays.size(); ++i) {
        renumbered[i] = next;
        if (stays[i]) ++next;
    }
    for (auto& triangle : mesh.triangles) {
        for (std::uint32_t& vertex : triangle) vertex = renumbered[vertex];
    }
    keep(mesh.vertices_g_m, stays);
    keep(mesh.normals_g, stays);
    keep(mesh.colors, stays);
}

}  // namespace

void remove_small_pieces(SurfaceMesh& mesh, int min_piece_triangles) {
    if (min_piece_triangles <= 0) return;
    Pieces pieces(mesh.vertices_g_m.size());
    for (const auto& triangle : mesh.triangles) {
        pieces.connect(triangle[0], triangle[1]);
        pieces.connect(triangle[0], triangle[2]);
    }
    std::vector<int> size(mesh.vertices_g_m.size(), 0);
    for (const auto& triangle : mesh.triangles) ++size[pieces.root(triangle[0])];
    std::erase_if(mesh.triangles,
                  [&](const auto& triangle) { return size[pieces.root(triangle[0])] < min_piece_triangles; });
    std::vector<bool> stays(mesh.vertices_g_m.size(), false);
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t vertex : triangle) stays[vertex] = true;
    }
    keep_vertices(mesh, stays);
}

}  // namespace touchstone
