#include "platform/openni2_drivers/simulator/projector.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "platform/openni2_drivers/simulator/projector_light.hpp"
#include "platform/openni2_drivers/simulator/scene.hpp"
#include "platform/openni2_drivers/simulator/simulator_source.hpp"
#include "platform/openni2_drivers/simulator/static_layer.hpp"
#include "platform/system/error.hpp"

namespace touchstone::sim {
namespace {

using Eigen::Vector2f;

const TableView view = make_table_view(1.0, 25.0);
constexpr int width_px = 640, height_px = 480;
constexpr std::size_t pixels = 640 * 480;

ProjectedPicture black() {
    return {1280, 800, 2, std::vector<std::uint8_t>(std::size_t{4} * 1280 * 800, 0), std::nullopt};
}

void paint(ProjectedPicture& picture, int x_px, int y_px, int size_px) {
    for (int y = y_px; y < y_px + size_px; ++y)
        for (int x = x_px; x < x_px + size_px; ++x)
            for (std::size_t channel = 0; channel < 3; ++channel)
                picture.rgba[4 * static_cast<std::size_t>(y * 1280 + x) + channel] = 255;
}

std::vector<std::uint8_t> shine(const Projector& projector, const Scene& scene,
                                const ProjectedPicture* picture, float ambient, int frame = 0) {
    std::vector<std::uint8_t> rgb(3 * pixels, 200);
    ProjectorLight(projector, ambient, 3).shine(rgb, render_static_depth(scene, view), view, picture, frame);
    return rgb;
}

/// Middle of what is brighter than `level`, weighted with its brightness.
Vector2f bright_middle(const std::vector<std::uint8_t>& rgb, int level) {
    Vector2f sum = Vector2f::Zero();
    float weights = 0.0F;
    for (int y = 0; y < height_px; ++y) {
        for (int x = 0; x < width_px; ++x) {
            const int value = rgb[3 * static_cast<std::size_t>(y * width_px + x)];
            if (value < level) continue;
            sum += static_cast<float>(value) * Vector2f(static_cast<float>(x), static_cast<float>(y));
            weights += static_cast<float>(value);
        }
    }
    return sum / weights;
}

TEST(Projector, LightsWhereItsRaysGo) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const Projector projector = make_projector(view, seed);
        for (const Vector2f& pixel :
             {Vector2f(10.0F, 20.0F), Vector2f(640.0F, 400.0F), Vector2f(1270.0F, 790.0F)}) {
            const Vec3 point_s = projector.position_s + 1.2F * projector.ray_s(pixel);
            EXPECT_LT((projector.pixel_px(point_s) - pixel).norm(), 0.02F);
        }
    }
}

TEST(Projector, LightsAllThatTheCameraSeesOfTheTableAndHasAShiftedLens) {
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
        const Projector projector = make_projector(view, seed);
        for (const float u : {5.0F, 634.0F}) {
            for (const float v : {20.0F, 474.0F}) {
                const Vector2f at = projector.pixel_px(view.on_table(u, v));
                EXPECT_TRUE(at.x() > -30.0F && at.x() < 1310.0F && at.y() > -30.0F && at.y() < 830.0F)
                    << seed << " " << u << " " << v << ": " << at.transpose();
            }
        }
        EXPECT_GT(std::abs(projector.center_px.y() - 400.0F), 100.0F);
        EXPECT_GT(projector.distortion[0], 0.0F);
    }
}

/// A white square of 9 pixels is seen where geometry says, to half a pixel.
TEST(ProjectorLight, ASquareIsSeenWhereItFalls) {
    const Scene table({});
    const Projector projector = make_projector(view, 7);
    for (const Vector2f& middle : {Vector2f(304.0F, 204.0F), Vector2f(804.0F, 604.0F)}) {
        ProjectedPicture picture = black();
        paint(picture, static_cast<int>(middle.x()) - 4, static_cast<int>(middle.y()) - 4, 9);
        const auto hit = first_hit(table, projector.position_s, projector.ray_s(middle).normalized());
        ASSERT_TRUE(hit);
        const Vector2f wanted = view.project(view.to_camera(*hit));
        EXPECT_LT((bright_middle(shine(projector, table, &picture, 0.0F), 40) - wanted).norm(), 0.5F);
    }
}

TEST(ProjectorLight, TheRoomIsAsBrightAsSaidAndNoiseDiffersFromFrameToFrame) {
    const Scene table({});
    const Projector projector = make_projector(view, 7);
    const ProjectedPicture picture = black();
    const auto dark = shine(projector, table, &picture, 0.0F), room = shine(projector, table, nullptr, 0.5F);
    double dark_sum = 0.0, room_sum = 0.0;
    for (std::size_t i = 0; i < room.size(); ++i) {
        dark_sum += dark[i];
        room_sum += room[i];
    }
    EXPECT_LT(dark_sum / static_cast<double>(room.size()), 2.0);
    EXPECT_NEAR(room_sum / static_cast<double>(room.size()), 100.0, 0.5);
    EXPECT_EQ(room, shine(projector, table, nullptr, 0.5F));
    EXPECT_NE(room, shine(projector, table, nullptr, 0.5F, 1));
}

/// A tall box beside the light's foot: behind it, seen from the projector, the table stays dark.
TEST(ProjectorLight, ThingsThrowShadows) {
    Shape box;
    box.center = {0.0F, 0.05F, 0.075F};
    box.half = {0.1F, 0.03F, 0.075F};
    const Scene scene({box});
    const Projector projector = make_projector(view, 7);
    ProjectedPicture picture = black();
    paint(picture, 0, 0, 800);
    paint(picture, 480, 0, 800);
    const auto rgb = shine(projector, scene, &picture, 0.0F);
    const auto at_camera = [&](const Vec3& point_s) {
        const Vector2f at = view.project(view.to_camera(point_s));
        return static_cast<int>(
            rgb[3 * static_cast<std::size_t>(std::lround(at.y()) * width_px + std::lround(at.x()))]);
    };
    // From the light over the far edge through the box's top edge to the table before it.
    const Vec3 edge(0.0F, 0.02F, 0.15F);
    const Vec3 beam = edge - projector.position_s;
    const Vec3 end = edge - beam * (edge.z() / beam.z());
    EXPECT_LT(at_camera(end + Vec3(0.0F, 0.015F, 0.0F)), 15) << "in its shadow";
    EXPECT_GT(at_camera(end - Vec3(0.0F, 0.04F, 0.0F)), 60) << "past its shadow";
}

TEST(SimulatorUri, OfAProjector) {
    const SimulatorConfig config =
        parse_simulator_uri("curved?projector=1&ambient=0.5&guided=1&projector_truth=p.json");
    EXPECT_TRUE(config.projector && config.guided);
    EXPECT_EQ(config.ambient, 0.5);
    EXPECT_EQ(config.projector_truth_path, "p.json");
    EXPECT_THROW(parse_simulator_uri("flat?guided=1"), Error);
    EXPECT_THROW(parse_simulator_uri("room?projector=1"), Error);
    EXPECT_THROW(parse_simulator_uri("flat?projector=1&ambient=2"), Error);
}

/// Two crosses one after the other, each touched; nothing is touched while nothing is asked.
TEST(GuidedHand, TouchesWhatIsAsked) {
    const SimulatorConfig config =
        parse_simulator_uri("curved?projector=1&guided=1&hands=1&seed=5&noise=0&empty=0.5");
    const Projector projector =
        make_projector(make_table_view(config.height_m, config.tilt_deg), config.seed);
    ProjectedPictureWriter writer(projected_picture_name(), 1280, 800);
    SimulatorSource source(config);
    SourceFrame frame;
    const auto background = [&] {
        source.next(frame);
        return frame.depth_mm;
    }();
    const TableView table_view = make_table_view(config.height_m, config.tilt_deg);
    const auto covers = [&](const Vec3& place_s) {
        const Vector2f at = table_view.project(table_view.to_camera(place_s));
        const auto pixel = static_cast<std::size_t>(std::lround(at.y()) * width_px + std::lround(at.x()));
        const int nearer_mm = background[pixel] - frame.depth_mm[pixel];
        const bool is_nearer = nearer_mm > 3;  // a step of disparity is 5 mm there
        return frame.depth_mm[pixel] > 0 && is_nearer && nearer_mm < 30;
    };
    const Scene scene = make_scene(config.scene, config.seed, table_view.on_table(639.0F, 239.5F).x());
    for (const Vector2f& asked : {Vector2f(500.0F, 300.0F), Vector2f(800.0F, 500.0F)}) {
        writer.show(black().rgba, 1280, 800, std::array{asked.x(), asked.y()});
        const auto place = first_hit(scene, projector.position_s, projector.ray_s(asked).normalized());
        ASSERT_TRUE(place);
        int frames_covered = 0;
        for (int i = 0; i < 150; ++i) {
            source.next(frame);
            frames_covered += covers(*place);
        }
        EXPECT_GT(frames_covered, 10) << asked.transpose();
    }
    writer.show(black().rgba, 1280, 800);
    for (int i = 0; i < 120; ++i) source.next(frame);
    EXPECT_EQ(frame.depth_mm, background) << "it went away";
}

}  // namespace
}  // namespace touchstone::sim
