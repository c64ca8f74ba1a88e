// Models drawn into maps against plain geometry.
#include "ui/mesh_rasteriser.hpp"

#include <gtest/gtest.h>
#include <numbers>

#include "platform/display/gl_error.hpp"
#include "platform/display/headless_display.hpp"

namespace touchstone {
namespace {

using Eigen::Vector3f;

constexpr Intrinsics k{290.f, 290.f, 159.5f, 119.5f, 320, 240, {0, 0}};

/// A ball of radius 1 about the origin, 200 x 100 facets: off by at most 0.5 mm in 1000.
MeshModel unit_ball() {
    MeshModel ball;
    constexpr int around = 200, down = 100;
    for (int i = 0; i <= down; ++i) {
        for (int j = 0; j < around; ++j) {
            const float a = std::numbers::pi_v<float> * static_cast<float>(i) / down;
            const float b = 2.f * std::numbers::pi_v<float> * static_cast<float>(j) / around;
            const Vector3f p(std::sin(a) * std::cos(b), std::cos(a), std::sin(a) * std::sin(b));
            ball.corners.push_back({p, p, {10, 200, 30, 255}});
        }
    }
    const auto at = [](int i, int j) { return static_cast<std::uint32_t>(i * around + j % around); };
    for (int i = 0; i < down; ++i) {
        for (int j = 0; j < around; ++j) {
            ball.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
            ball.triangles.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
        }
    }
    return ball;
}

/// A square of side 2 in the plane z = 0, its normals along -z.
MeshModel square() {
    MeshModel model;
    for (const auto& [x, y] :
         {std::pair(-1.f, -1.f), std::pair(1.f, -1.f), std::pair(1.f, 1.f), std::pair(-1.f, 1.f)})
        model.corners.push_back({{x, y, 0.f}, -Vector3f::UnitZ(), {255, 0, 0, 255}});
    model.triangles = {{0, 1, 2}, {0, 2, 3}};
    return model;
}

class MeshRasteriserTest : public testing::Test {
  protected:
    static std::size_t at(int x, int y) { return static_cast<std::size_t>(y * k.width_px + x); }
    static Vector3f normal(const MeshPicture& picture, int x, int y) {
        const std::size_t pixels = picture.depth_m.size();
        return {picture.normals_c[at(x, y)], picture.normals_c[pixels + at(x, y)],
                picture.normals_c[2 * pixels + at(x, y)]};
    }
    std::unique_ptr<Display> display_ = make_headless_display({64, 64});
};

/// Depth to a millimetre, normals to a degree, its outline to a pixel.
TEST_F(MeshRasteriserTest, ABallHasItsDepthAndNormals) {
    MeshRasteriser rasteriser(unit_ball(), k);
    RigidTransform T_v_m = RigidTransform::Identity();
    const Vector3f centre(0.1f, -0.05f, 1.f);
    T_v_m.translation() = centre;
    constexpr float radius = 0.2f;
    const auto picture = rasteriser.draw(T_v_m, radius);
    ASSERT_EQ(take_gl_errors(), "");
    int covered = 0;
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            const Vector3f ray = back_project(k, x, y, 1.f);
            const float b = ray.dot(centre), a = ray.squaredNorm(),
                        c = centre.squaredNorm() - radius * radius;
            const float discriminant = b * b - a * c;
            const float depth_m = picture->depth_m[at(x, y)];
            // One pixel is 3.4 mm there: the ray's distance from the centre.
            const float from_centre = std::sqrt(std::max(0.f, centre.squaredNorm() - b * b / a));
            if (from_centre > radius + 0.0035f) {
                ASSERT_EQ(depth_m, 0.f) << x << ", " << y;
            }
            if (from_centre > radius - 0.0035f) continue;
            const float z = (b - std::sqrt(discriminant)) / a;
            ASSERT_NEAR(depth_m, z, from_centre < 0.9f * radius ? 0.001f : 0.004f) << x << ", " << y;
            const Vector3f expected = (z * ray - centre) / radius;
            ASSERT_GT(normal(*picture, x, y).dot(expected), from_centre < 0.9f * radius ? 0.9995f : 0.99f);
            ASSERT_EQ(picture->rgba[at(x, y)], 0xff1ec80aU);
            ++covered;
        }
    }
    EXPECT_GT(covered, 9000);
}

TEST_F(MeshRasteriserTest, BothSidesOfASquareFaceTheCameraAndRowZeroIsTheTop) {
    MeshRasteriser rasteriser(square(), k);
    RigidTransform T_v_m = RigidTransform::Identity();
    T_v_m.translation() = Vector3f(0.f, -0.2f, 1.f);
    const auto front = rasteriser.draw(T_v_m, 0.1f);
    T_v_m.linear() = Eigen::AngleAxisf(std::numbers::pi_v<float>, Vector3f::UnitY()).toRotationMatrix();
    const auto back = rasteriser.draw(T_v_m, 0.1f);
    // From y = -0.3 to -0.1 m: rows 32.5 to 90.5.
    for (const auto& picture : {front, back}) {
        EXPECT_EQ(picture->depth_m[at(160, 31)], 0.f);
        EXPECT_NEAR(picture->depth_m[at(160, 34)], 1.f, 1e-5f);
        EXPECT_NEAR(picture->depth_m[at(160, 89)], 1.f, 1e-5f);
        EXPECT_EQ(picture->depth_m[at(160, 92)], 0.f);
        EXPECT_LT((normal(*picture, 160, 60) + Vector3f::UnitZ()).norm(), 0.01f);
    }
}

TEST_F(MeshRasteriserTest, TheNearerPartHidesTheOther) {
    MeshModel two = square();
    for (int i = 0; i < 4; ++i) {
        MeshModel::Corner corner = two.corners[static_cast<std::size_t>(i)];
        corner.position.z() = -1.f;
        corner.rgba = {0, 0, 255, 255};
        two.corners.push_back(corner);
    }
    two.triangles.push_back({4, 5, 6});
    two.triangles.push_back({4, 6, 7});
    MeshRasteriser rasteriser(two, k);
    RigidTransform T_v_m = RigidTransform::Identity();
    T_v_m.translation().z() = 1.f;
    const auto picture = rasteriser.draw(T_v_m, 0.1f);
    EXPECT_NEAR(picture->depth_m[at(160, 120)], 0.9f, 1e-5f);
    EXPECT_EQ(picture->rgba[at(160, 120)], 0xffff0000U);
}

/// What was there is gone; what the view does not show is cut off, also where the model reaches behind it.
TEST_F(MeshRasteriserTest, WhatIsOutOfViewIsNotThere) {
    MeshRasteriser rasteriser(square(), k);
    RigidTransform T_v_m = RigidTransform::Identity();
    T_v_m.translation().z() = 1.f;
    rasteriser.draw(T_v_m, 0.1f);
    for (const Vector3f& place :
         {Vector3f(5.f, 0.f, 1.f), Vector3f(0.f, 0.f, -1.f), Vector3f(0.f, 0.f, 9.f)}) {
        T_v_m.translation() = place;
        const auto picture = rasteriser.draw(T_v_m, 0.1f);
        EXPECT_EQ(std::ranges::count(picture->depth_m, 0.f), k.width_px * k.height_px);
    }
    T_v_m.translation() = Vector3f(0.f, 0.f, 0.f);
    T_v_m.linear() = Eigen::AngleAxisf(1.f, Vector3f::UnitX()).toRotationMatrix();
    const auto crossing = rasteriser.draw(T_v_m, 1.f);
    for (const float depth_m : crossing->depth_m) EXPECT_TRUE(depth_m == 0.f || depth_m > 0.049f);
    EXPECT_EQ(take_gl_errors(), "");
}

TEST(MeshModel, StandsOnItsFootAndIsOneHigh) {
    MeshModel model = square();
    for (MeshModel::Corner& corner : model.corners) {
        corner.position = 3.f * corner.position + Vector3f(5.f, 7.f, -2.f);
        corner.normal *= 4.f;
    }
    model = standing(model);
    Eigen::AlignedBox3f box;
    for (const MeshModel::Corner& corner : model.corners) {
        box.extend(corner.position);
        EXPECT_NEAR(corner.normal.norm(), 1.f, 1e-5f);
    }
    EXPECT_LT((box.min() - Vector3f(-0.5f, 0.f, 0.f)).norm(), 1e-5f);
    EXPECT_LT((box.max() - Vector3f(0.5f, 1.f, 0.f)).norm(), 1e-5f);
}

TEST(MeshModel, TheVaseIsOneHighAndItsNormalsPointOut) {
    const MeshModel vase = make_vase();
    float top = 0.f;
    for (const MeshModel::Corner& corner : vase.corners) {
        top = std::max(top, corner.position.y());
        EXPECT_NEAR(corner.normal.norm(), 1.f, 1e-4f);
        const Vector3f out(corner.position.x(), 0.f, corner.position.z());
        EXPECT_GE(corner.normal.dot(out), 0.f);
    }
    EXPECT_NEAR(top, 1.f, 1e-5f);
}

}  // namespace
}  // namespace touchstone
