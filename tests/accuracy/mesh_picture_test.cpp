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

TEST(MeshPicture, TheWholeMeshFillsThePicture) {
    SurfaceMesh mesh;
    add_square(mesh, 3.0f, 2.0f, {0, 200, 0});
    add_square(mesh, 2.0f, 1.0f, {0, 200, 0});
    for (const Eigen::Vector3f& direction :
         {Eigen::Vector3f(0.0f, 0.0f, -1.0f), Eigen::Vector3f(0.5f, 0.7f, -1.0f)}) {
        const Image8 image = draw_mesh(mesh, whole_mesh(mesh, direction));
        int left = image.width_px, right = 0, top = image.height_px, bottom = 0;
        for (int y = 0; y < image.height_px; ++y) {
            for (int x = 0; x < image.width_px; ++x) {
                if (pixel(image, x, y)[1] <= 24) continue;
                left = std::min(left, x);
                right = std::max(right, x);
                top = std::min(top, y);
                bottom = std::max(bottom, y);
            }
        }
        EXPECT_GT(std::min({left, top, image.width_px - 1 - right, image.height_px - 1 - bottom}), 0);
        const bool fills = right - left > image.width_px / 2 || bottom - top > image.height_px / 2;
        EXPECT_TRUE(fills);
    }
}

}  // namespace
}  // namespace touchstone
