#include "pipeline/mesh_file.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cctype>
#include <fmt/format.h>
#include <iterator>
#include <string>

#include "platform/system/atomic_file.hpp"
#include "platform/system/error.hpp"

namespace touchstone {
namespace {

static_assert(std::endian::native == std::endian::little, "values are written as they are in memory");

enum class MeshFormat { ply, obj, stl };

MeshFormat format_of(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (ending == ".ply") return MeshFormat::ply;
    if (ending == ".obj") return MeshFormat::obj;
    if (ending == ".stl") return MeshFormat::stl;
    throw Error(
        ExitStatus::usage,
        fmt::format("{}: the ending says what a mesh is written as; use .ply, .obj or .stl", path.string()));
}

template <class T>
void append(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void append(std::string& bytes, const Eigen::Vector3f& v) {
    for (const float x : {v.x(), v.y(), v.z()}) append(bytes, x);
}

std::string ply_header(const SurfaceMesh& mesh) {
    return fmt::format(
        "ply\nformat binary_little_endian 1.0\ncomment Touchstone, metres\nelement vertex {}\n"
        "property float x\nproperty float y\nproperty float z\n"
        "property float nx\nproperty float ny\nproperty float nz\n{}"
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.vertices_g_m.size(),
        mesh.colors.empty() ? "" : "property uchar red\nproperty uchar green\nproperty uchar blue\n",
        mesh.triangles.size());
}

std::string ply_of(const SurfaceMesh& mesh) {
    std::string bytes = ply_header(mesh);
    const std::size_t first_value = bytes.size();
    bytes.reserve(bytes.size() + mesh.vertices_g_m.size() * 27 + mesh.triangles.size() * 13);
    for (std::size_t i = 0; i < mesh.vertices_g_m.size(); ++i) {
        append(bytes, mesh.vertices_g_m[i]);
        append(bytes, mesh.normals_g[i]);
        if (!mesh.colors.empty()) append(bytes, mesh.colors[i]);
    }
    for (const auto& triangle : mesh.triangles) {
        append(bytes, std::uint8_t{3});
        append(bytes, triangle);
    }
    // assimp takes a line feed here for part of the header and reads all that follows one byte late (its
    // issue 5341). It is the lowest byte of the first coordinate: one unit in the last place more does no
    // harm.
    if (bytes.size() > first_value && bytes[first_value] == '\n') ++bytes[first_value];
    return bytes;
}

std::string obj_of(const SurfaceMesh& mesh) {
    std::string text = "# Touchstone, metres\n";
    text.reserve(mesh.vertices_g_m.size() * 90 + mesh.triangles.size() * 48);
    const auto out = std::back_inserter(text);
    for (std::size_t i = 0; i < mesh.vertices_g_m.size(); ++i) {
        const Eigen::Vector3f& v = mesh.vertices_g_m[i];
        fmt::format_to(out, "v {:.6f} {:.6f} {:.6f}", v.x(), v.y(), v.z());
        if (!mesh.colors.empty()) {
            const auto [red, green, blue] = mesh.colors[i];
            fmt::format_to(out, " {:.4f} {:.4f} {:.4f}", red / 255.0f, green / 255.0f, blue / 255.0f);
        }
        text.push_back('\n');
    }
    for (const auto& n : mesh.normals_g)
        fmt::format_to(out, "vn {:.4f} {:.4f} {:.4f}\n", n.x(), n.y(), n.z());
    for (const auto& [a, b, c] : mesh.triangles) {
        fmt::format_to(out, "f {0}//{0} {1}//{1} {2}//{2}\n", a + 1, b + 1, c + 1);
    }
    return text;
}

Eigen::Vector3f triangle_normal(const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                                const Eigen::Vector3f& c) {
    const Eigen::Vector3f turned = (b - a).cross(c - a);
    return turned.squaredNorm() > 0.0f ? turned.normalized() : turned;
}

std::string stl_of(const SurfaceMesh& mesh) {
    std::string bytes = "Touchstone, metres";  // not "solid": that would be a text STL
    bytes.resize(80, ' ');
    bytes.reserve(84 + mesh.triangles.size() * 50);
    append(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const auto& triangle : mesh.triangles) {
        const auto corner = [&](std::size_t k) { return mesh.vertices_g_m[triangle[k]]; };
        append(bytes, triangle_normal(corner(0), corner(1), corner(2)));
        for (std::size_t k = 0; k < 3; ++k) append(bytes, corner(k));
        append(bytes, std::uint16_t{0});
    }
    return bytes;
}

std::string bytes_of(MeshFormat format, const SurfaceMesh& mesh) {
    if (format == MeshFormat::ply) return ply_of(mesh);
    if (format == MeshFormat::obj) return obj_of(mesh);
    return stl_of(mesh);
}

}  // namespace

void check_mesh_ending(const std::filesystem::path& path) { format_of(path); }

void write_mesh(const std::filesystem::path& path, const SurfaceMesh& mesh) {
    write_file_atomically(path, bytes_of(format_of(path), mesh));
}

}  // namespace touchstone
