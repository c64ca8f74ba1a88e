#include "pipeline/surface_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "pipeline/cell_triangles.hpp"
#include "pipeline/surface_cells.hpp"

namespace touchstone {
namespace {

constexpr float least_distance_vox = 0.01f;  ///< of a voxel centre to the surface
constexpr std::array<std::uint8_t, 3> grey = {128, 128, 128};

/// Vertices of one brick's crossed edges.
class BrickVertices {
  public:
    BrickVertices(const VolumeSnapshot& snapshot, const BrickLookup& colors, const BrickLookup& lookup,
                  const std::array<int, 3>& brick, int min_weight)
        : snapshot_(snapshot),
          around_(lookup, brick),
          colors_around_(colors, brick),
          corner_vox_(Eigen::Vector3i(brick[0], brick[1], brick[2]) * BRICK_VOX),
          min_weight_(min_weight) {
        const VolumeParams params = make_volume_params(snapshot.config);
        voxel_m_ = params.voxel_m;
        least_tsdf_ = least_distance_vox * voxel_m_ / params.max_truncation_m * TSDF_SCALE;
    }

    void add(int voxel, int axis, SurfaceMesh& mesh) const {
        const Eigen::Vector3i start(voxel & 7, voxel >> 3 & 7, voxel >> 6);
        const Eigen::Vector3i end = start + Eigen::Vector3i::Unit(axis);
        const float from = *tsdf(start), to = *tsdf(end);  // known: the edge is one of a surface cell
        const float share = off_surface(from) / (off_surface(from) - off_surface(to));
        Eigen::Vector3f place_vox = (corner_vox_ + start).cast<float>().array() + 0.5f;
        place_vox[axis] += share;
        mesh.vertices_g_m.push_back(place_vox * voxel_m_);
        const Eigen::Vector3f slope = (1.0f - share) * gradient(start) + share * gradient(end);
        const Eigen::Vector3f along_edge = Eigen::Vector3f::Unit(axis) * (to > from ? 1.0f : -1.0f);
        mesh.normals_g.push_back(slope.squaredNorm() > 0.0f ? slope.normalized() : along_edge);
        if (!snapshot_.colors.empty()) mesh.colors.push_back(color(start, end, share));
    }

  private:
    std::optional<float> tsdf(const Eigen::Vector3i& at) const {
        const std::size_t index = around_.index(at.x(), at.y(), at.z());
        if (index == BrickNeighbourhood::absent) return std::nullopt;
        const std::int32_t voxel = snapshot_.voxels[index];
        if (voxel_weight(voxel) < min_weight_) return std::nullopt;
        return static_cast<float>(voxel_tsdf(voxel));
    }

    /// A voxel on the surface counts as a little inside, so that its edges' vertices do not fall together.
    float off_surface(float tsdf) const {
        return tsdf > 0.0f ? std::max(tsdf, least_tsdf_) : std::min(tsdf, -least_tsdf_);
    }

    /// Central differences, one-sided beside unknown voxels; any unit of length.
    Eigen::Vector3f gradient(const Eigen::Vector3i& at) const {
        const float here = *tsdf(at);
        Eigen::Vector3f result;
        for (int axis = 0; axis < 3; ++axis) {
            const auto before = tsdf(at - Eigen::Vector3i::Unit(axis));
            const auto after = tsdf(at + Eigen::Vector3i::Unit(axis));
            const float span = (before ? 1.0f : 0.0f) + (after ? 1.0f : 0.0f);
            result[axis] = span > 0.0f ? (after.value_or(here) - before.value_or(here)) / span : 0.0f;
        }
        return result;
    }

    std::uint32_t packed_color(const Eigen::Vector3i& at) const {
        const std::size_t index = colors_around_.index(at.x(), at.y(), at.z());
        return index == BrickNeighbourhood::absent ? 0 : snapshot_.colors[index];
    }

    std::array<std::uint8_t, 3> color(const Eigen::Vector3i& start, const Eigen::Vector3i& end,
                                      float share) const {
        const std::uint32_t a = packed_color(start), b = packed_color(end);
        const float weight_a = a >> 24 != 0 ? 1.0f - share : 0.0f, weight_b = b >> 24 != 0 ? share : 0.0f;
        if (weight_a + weight_b <= 0.0f) return grey;
        std::array<std::uint8_t, 3> result{};
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const auto value = [&](std::uint32_t packed) {
                return static_cast<float>(packed >> 8 * channel & 0xff);
            };
            result[channel] = static_cast<std::uint8_t>(
                std::lround((weight_a * value(a) + weight_b * value(b)) / (weight_a + weight_b)));
        }
        return result;
    }

    const VolumeSnapshot& snapshot_;
    BrickNeighbourhood around_, colors_around_;
    Eigen::Vector3i corner_vox_;
    float voxel_m_, least_tsdf_;
    int min_weight_;
};

void add_vertices(const VolumeSnapshot& snapshot, const BrickLookup& lookup, const SurfaceCells& surface,
                  int min_weight, SurfaceMesh& mesh) {
    const BrickLookup colors(snapshot.color_bricks, lookup.bricks_per_side());
    mesh.vertices_g_m.reserve(surface.edge_count);
    mesh.normals_g.reserve(surface.edge_count);
    if (!snapshot.colors.empty()) mesh.colors.reserve(surface.edge_count);
    for (std::size_t slot = 0; slot < snapshot.bricks.size(); ++slot) {
        const auto brick = brick_place(snapshot.bricks[slot], lookup.bricks_per_side());
        const BrickVertices vertices(snapshot, colors, lookup, brick, min_weight);
        for (std::size_t word = 0; word < surface.edges[slot].crossed.size(); ++word) {
            for (std::uint64_t left = surface.edges[slot].crossed[word]; left != 0; left &= left - 1) {
                const int edge = static_cast<int>(word) * 64 + std::countr_zero(left);
                vertices.add(edge / 3, edge % 3, mesh);
            }
        }
    }
}

void add_triangles(const VolumeSnapshot& snapshot, const BrickLookup& lookup, const SurfaceCells& surface,
                   SurfaceMesh& mesh) {
    mesh.triangles.reserve(2 * surface.cells.size());
    for (std::size_t slot = 0; slot < snapshot.bricks.size(); ++slot) {
        if (surface.first_cell[slot] == surface.first_cell[slot + 1]) continue;
        const BrickNeighbourhood around(lookup, brick_place(snapshot.bricks[slot], lookup.bricks_per_side()));
        for (std::size_t i = surface.first_cell[slot]; i < surface.first_cell[slot + 1]; ++i) {
            const CellCase& found = cell_case(surface.cells[i].inside);
            for (std::size_t t = 0; t < found.triangle_count; ++t) {
                auto& triangle = mesh.triangles.emplace_back();
                for (std::size_t k = 0; k < 3; ++k) {
                    const EdgeAddress at = edge_address(around, surface.cells[i], found.triangles[t][k]);
                    triangle[k] = surface.edges[at.slot].number(at.edge);
                }
            }
        }
    }
}

}  // namespace

SurfaceMesh extract_surface(const VolumeSnapshot& snapshot, const SurfaceMeshConfig& config) {
    const int min_weight = std::max(config.min_weight, 1);
    const BrickLookup lookup(snapshot.bricks, snapshot.config.size_vox / BRICK_VOX);
    const SurfaceCells surface = find_surface_cells(snapshot, lookup, min_weight);
    SurfaceMesh mesh;
    add_vertices(snapshot, lookup, surface, min_weight, mesh);
    add_triangles(snapshot, lookup, surface, mesh);
    remove_small_pieces(mesh, config.min_piece_triangles);
    return mesh;
}

}  // namespace touchstone
