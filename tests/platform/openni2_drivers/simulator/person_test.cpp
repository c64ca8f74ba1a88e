#include "platform/openni2_drivers/simulator/person.hpp"

#include <gtest/gtest.h>

#include "platform/image/png_file.hpp"
#include "platform/openni2_drivers/simulator/mesh_source.hpp"
#include "platform/openni2_drivers/simulator/scene_view.hpp"
#include "tests/platform/openni2_drivers/simulator/pose_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone::sim {
namespace {

double share_of(const Picture& picture) {
    const auto pixels = std::ranges::count_if(picture.part, [](std::uint8_t part) { return part != 0; });
    return static_cast<double>(pixels) / static_cast<double>(picture.part.size());
}

/// Furniture covers some of it and they walk to and fro: the mean over ten seconds is as wanted, within a
/// fifth.
TEST(Person, CoversAboutTheWantedShareOfThePixels) {
    for (const double wanted : {0.2, 0.4}) {
        SimulatorConfig config = parse_simulator_uri("room?motion=sweep&seed=3");
        config.person = wanted;
        const auto view = make_moving_view(config);
        Picture picture;
        double sum = 0.0;
        for (int frame = 0; frame < 300; frame += 20) {
            (void)view->draw(frame, picture);
            sum += share_of(picture);
            EXPECT_GT(share_of(picture), 0.2 * wanted) << frame;
        }
        EXPECT_NEAR(sum / 15.0, wanted, wanted / 5.0);
    }
}

TEST(Person, ComesInFromTheSide) {
    Picture picture;
    const auto view = make_moving_view(parse_simulator_uri("room?motion=sweep&seed=3&person=0.2&person_s=1"));
    for (const int frame : {0, 15, 30}) {
        (void)view->draw(frame, picture);
        EXPECT_EQ(share_of(picture), 0.0) << frame;
    }
    (void)view->draw(110, picture);
    EXPECT_GT(share_of(picture), 0.05);
}

/// Walks by less than 40 mm a frame, and not with the camera alone: in the scene and before the camera.
TEST(Person, WalksSmoothly) {
    const CameraPath path(CameraMotion::sweep, room_viewpoint(), 4);
    const Person person(path, 1.2, 0, 4);
    float farthest_m = 0.0f, farthest_c_m = 0.0f;
    const auto chest = [&](int frame) -> Vec3 { return person.at(frame).parts[0].cone.a; };
    const auto chest_c = [&](int frame) -> Vec3 {
        return (path.at(frame).inverse() * chest(frame).cast<double>()).cast<float>();
    };
    for (int frame = 0; frame < 200; ++frame) {
        EXPECT_LT((chest(frame + 1) - chest(frame)).norm(), 0.04f) << frame;
        farthest_m = std::max(farthest_m, (chest(frame) - chest(0)).norm());
        farthest_c_m = std::max(farthest_c_m, (chest_c(frame) - chest_c(0)).norm());
    }
    EXPECT_GT(farthest_m, 0.3f);
    EXPECT_GT(farthest_c_m, 0.3f);
}

TEST(Person, TheSeedDecidesEveryPixelAndTheMaskIsTheBody) {
    const TemporaryFolder folder;
    const std::string uri = "room?motion=sweep&frames=2&noise=0&masks=" + folder.path().string() + "&seed=";
    const std::vector<SourceFrame> other = play(uri + "6&person=0.3");
    const std::vector<SourceFrame> one = play(uri + "5&person=0.3", true);
    const std::vector<SourceFrame> same = play(uri + "5&person=0.3", true);
    const std::vector<std::uint8_t> mask = read_png_8(folder.path() / "truth-000001.mask.png").pixels;
    const std::vector<SourceFrame> alone = play("room?motion=sweep&frames=2&noise=0&seed=5");
    EXPECT_EQ(one[1].depth_mm, same[1].depth_mm);
    EXPECT_EQ(one[1].color_rgb, same[1].color_rgb);
    EXPECT_NE(one[1].depth_mm, other[1].depth_mm);
    for (std::size_t i = 0; i < mask.size(); ++i) {
        if (mask[i] == 0)
            ASSERT_EQ(one[1].depth_mm[i], alone[1].depth_mm[i]) << i;
        else
            ASSERT_LE(one[1].depth_mm[i], alone[1].depth_mm[i]) << i;
    }
}

}  // namespace
}  // namespace touchstone::sim
