#include "tests/accuracy/mesh_picture.hpp"

#include <gtest/gtest.h>

namespace touchstone {
namespace {

/// A square of side 2 m in the plane z, counter-clockwise seen from z = -infinity.
void add_square(SurfaceMesh& mesh, float x, float z, const std::array<std::uint8_t, 3>& color) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices_g_m.size());
    for (const auto& [u, v] : {std::pair{-1.0f, -1.0f}, {-1.0f, 1.0f}, {1.0f, 1.0f}, {1.0f, -1.0f}}) {
        mesh.vertices_g_m.emplace_back(x + u, v, z);
        mesh.colors.push_back(color);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
}

std::array<int, 3> pixel(const Image8& image, int x, int y) {
    const auto at = static_cast<std::size_t>(3 * (y * image.width_px + x));
    return {image.pixels[at], image.pixels[at + 1], image.pixels[at + 2]};
}

PictureConfig from_minus_z() {
    PictureConfig config;
    config.eye_m = {0.0f, 0.0f, -5.0f};
    config.look_at_m = Eigen::Vector3f::Zero();
    config.field_of_view_rad = 1.0f;
    config.width_px = config.height_px = 101;
    return config;
}

TEST(MeshPicture, NearerTrianglesHideFartherOnesInAnyOrder) {
    for (const bool near_first : {true, false}) {
        SurfaceMesh mesh;
        if (near_first) add_square(mesh, 0.5f, 0.0f, {200, 0, 0});
        add_square(mesh, -0.5f, 1.0f, {0, 200, 0});
        if (!near_first) add_square(mesh, 0.5f, 0.0f, {200, 0, 0});
        const Image8 image = draw_mesh(mesh, from_minus_z());
        EXPECT_GT(pixel(image, 50, 50)[0], 150) << "both are there";
        EXPECT_GT(pixel(image, 60, 50)[0], 150) << "x grows to the right";
        EXPECT_GT(pixel(image, 30, 50)[1], 150);
        EXPECT_EQ(pixel(image, 2, 2), (std::array<int, 3>{24, 24, 24}));
    }
}

TEST(MeshPicture, BacksAreRedAndWhatIsBehindTheViewerIsNotDrawn) {
    SurfaceMesh mesh;
    add_square(mesh, 0.0f, 0.0f, {0, 200, 0});
    PictureConfig config = from_minus_z();
    config.eye_m.z() = 5.0f;
    const auto back = pixel(draw_mesh(mesh, config), 50, 50);
    EXPECT_GT(back[0], 100);
    EXPECT_LT(back[1], 100);
    config.look_at_m.z() = 10.0f;
    EXPECT_EQ(pixel(draw_mesh(mesh, config), 50, 50), (std::array<int, 3>{24, 24, 24}));
}

TEST(MeshPicture, TheWholeMeshIsSeen) {
    SurfaceMesh mesh;
    add_square(mesh, 3.0f, 2.0f, {0, 200, 0});
    const Image8 image = draw_mesh(mesh, whole_mesh(mesh, -Eigen::Vector3f::UnitZ()));
    EXPECT_GT(pixel(image, image.width_px / 2, image.height_px / 2)[1], 150);
    for (int x = 0; x < image.width_px; ++x) ASSERT_EQ(pixel(image, x, 0)[1], 24);
    for (int y = 0; y < image.height_px; ++y) ASSERT_EQ(pixel(image, 0, y)[1], 24);
}

}  // namespace
}  // namespace touchstone
