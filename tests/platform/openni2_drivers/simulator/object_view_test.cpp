#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>

#include "platform/image/png_file.hpp"
#include "platform/openni2_drivers/simulator/holding_hands.hpp"
#include "platform/openni2_drivers/simulator/mesh_distance.hpp"
#include "platform/openni2_drivers/simulator/mesh_source.hpp"
#include "platform/openni2_drivers/simulator/rasteriser.hpp"
#include "platform/openni2_drivers/simulator/scene_view.hpp"
#include "platform/openni2_drivers/simulator/simulator_source.hpp"
#include "platform/openni2_drivers/simulator/turned_object.hpp"
#include "tests/support/expect_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone::sim {
namespace {

constexpr float wall_from_m = 1.7F;

Eigen::Vector3d point_c(std::size_t pixel, float z_m) {
    const auto z = static_cast<double>(z_m);
    return {z * (static_cast<double>(pixel % 640) - 319.5) / 575.8,
            z * (static_cast<double>(pixel / 640) - 239.5) / 575.8, z};
}

/// Distance of a point from the axis of a part, less its larger radius: 0 or less on and in the part.
double beyond_m(const Eigen::Vector3d& point, const RoundCone& cone) {
    const Eigen::Vector3d a = cone.a.cast<double>();
    const Eigen::Vector3d along = cone.b.cast<double>() - a;
    const double share = std::clamp(along.dot(point - a) / along.squaredNorm(), 0.0, 1.0);
    return (a + share * along - point).norm() - static_cast<double>(std::max(cone.radius_a, cone.radius_b));
}

/// Every 7th pixel lies on the object, a hand or the wall, in the frame of each.
void expect_all_in_place(const SimulatorConfig& config, int frame) {
    const TriangleMesh mesh = truth_mesh(config);
    const MeshDistance truth(mesh);
    const TurnedObject turned(config.seed);
    const HoldingHands hands(mesh, turned, config.seed);
    Picture picture;
    const Eigen::Isometry3d T_o_c = make_object_view(config)->draw(frame, picture);
    const int time = TurnedObject::folded(frame);
    const Eigen::Isometry3d T_w_c = turned.at(time) * T_o_c;
    int on_object = 0, on_hands = 0, on_wall = 0;
    for (std::size_t i = 0; i < picture.depth_m.size(); i += 7) {
        const Eigen::Vector3d p_w = T_w_c * point_c(i, picture.depth_m[i]);
        if (picture.part[i] != 0) {
            const Hand hand = hands.at(picture.owner[i], time);
            EXPECT_LT(beyond_m(p_w, hand.parts[picture.part[i] - 1U].cone), 1e-5);
            ++on_hands;
        } else if (p_w.y() > 1.5) {
            EXPECT_NEAR(p_w.y(), 1.8, 1e-5);
            ++on_wall;
        } else {
            EXPECT_LT(truth.distance_m(T_o_c * point_c(i, picture.depth_m[i])), 1e-6);
            EXPECT_LT((p_w - turned.at(time).translation()).norm(), 0.2);
            ++on_object;
        }
    }
    EXPECT_GT(on_object, 600);
    EXPECT_GT(on_hands, 600);
    EXPECT_GT(on_wall, 30000);
}

TEST(ObjectView, ThePoseIsTheCamerasInTheFrameOfTheTruth) {
    for (const int frame : {0, 37, 203, 411, 600, 700})
        expect_all_in_place(parse_simulator_uri("object?grip=fingers&size_m=0.2&seed=4"), frame);
}

TEST(ObjectView, AKnockedCameraSeesTheSameThings) {
    const SimulatorConfig config =
        parse_simulator_uri("object?grip=fingers&knock_s=1&knock_deg=5&knock_mm=50&seed=3");
    expect_all_in_place(config, 29);
    expect_all_in_place(config, 30);
}

TEST(ObjectView, WithoutHandsItFloats) {
    const auto view = make_object_view(parse_simulator_uri("object?seed=4"));
    Picture picture;
    view->draw(60, picture);
    EXPECT_EQ(std::count(picture.part.begin(), picture.part.end(), 0), 640 * 480);
}

/// Share of the surface that the camera sees past the hands, not grazing, in at least `frames` of the play.
double seen_share(const SimulatorConfig& config, int frames) {
    constexpr int step = 9;
    const TriangleMesh mesh = truth_mesh(config);
    const auto view = make_object_view(config);
    Picture picture;
    Raster raster;
    std::vector<int> seen(mesh.triangles.size(), 0);
    for (int frame = 0; frame < TurnedObject::frames; frame += step) {
        const Eigen::Isometry3d T_o_c = view->draw(frame, picture);
        rasterise(mesh, T_o_c.inverse(), kinect_intrinsics(), raster);
        std::vector<bool> now(mesh.triangles.size(), false);
        for (std::size_t i = 0; i < raster.triangle.size(); ++i)
            if (raster.triangle[i] >= 0 && picture.part[i] == 0)
                now[static_cast<std::size_t>(raster.triangle[i])] = true;
        for (std::size_t t = 0; t < now.size(); ++t) {
            const Vec3 corner = mesh.vertices[mesh.triangles[t][0]];
            const Vec3 ray = (T_o_c.translation().cast<float>() - corner).normalized();
            seen[t] += now[t] && triangle_normal(mesh, t).dot(ray) > 0.3F ? step : 0;
        }
    }
    double area = 0.0, seen_area = 0.0;
    for (std::size_t t = 0; t < seen.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const auto doubled = static_cast<double>(
            (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).norm());
        area += doubled;
        if (seen[t] >= frames) seen_area += doubled;
    }
    return seen_area / area;
}

TEST(ObjectView, TheWholeBowlIsSeenForManyFramesPastTheHands) {
    EXPECT_GT(seen_share(parse_simulator_uri("object?grip=fingers"), 27), 0.98);
}

TEST(ObjectView, MasksAreTheHands) {
    const TemporaryFolder folder;
    const auto source = open_simulator("object?grip=fingers&frames=1&masks=" + folder.path().string());
    SourceFrame frame;
    ASSERT_TRUE(source->next(frame));
    const Image8 mask = read_png_8(folder / "truth-000000.mask.png");
    EXPECT_EQ(read_png_16(folder / "frame-000000.depth.png").pixels, frame.depth_mm);
    EXPECT_GT(std::count(mask.pixels.begin(), mask.pixels.end(), 255), 5000);
}

TEST(ObjectView, ColoursShowObjectHandsAndWall) {
    const SimulatorConfig config = parse_simulator_uri("object?grip=fingers");
    const auto view = make_object_view(config);
    Picture picture;
    std::vector<std::uint8_t> rgb;
    view->draw(20, picture);
    view->color(picture, rgb);
    ASSERT_EQ(rgb.size(), 3U * 640U * 480U);
    // The bowl is bluish, the wall is not.
    for (std::size_t i = 0; i < picture.depth_m.size(); i += 5) {
        EXPECT_GT(rgb[3 * i + 1], 0);
        if (picture.part[i] != 0) continue;
        const bool bluish = rgb[3 * i + 2] > rgb[3 * i];
        EXPECT_EQ(bluish, picture.depth_m[i] < wall_from_m);
    }
}

TEST(ObjectView, ABadMeshIsRefusedWhenTheSensorOpens) {
    expect_error([] { open_simulator("object?mesh=/nowhere/cow.obj"); }, ExitStatus::no_input,
                 testing::HasSubstr("/nowhere/cow.obj"));
}

}  // namespace
}  // namespace touchstone::sim
