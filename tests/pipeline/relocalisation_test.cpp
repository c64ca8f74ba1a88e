#include "pipeline/relocalisation.hpp"

#include <gtest/gtest.h>

#include "pipeline/realignment.hpp"
#include "tests/support/fusion_chain.hpp"
#include "tests/support/global_scene.hpp"

namespace touchstone {
namespace {

using Eigen::Vector3f;

/// A corner of walls with three boxes: every direction is told by the view.
test::Surface corner() {
    return test::nearest(
        {test::box({-1.f, -1.f, 1.5f}, {3.f, 3.f, 1.8f}), test::box({1.3f, -1.f, -1.f}, {1.6f, 3.f, 1.8f}),
         test::box({-1.f, 1.15f, -1.f}, {3.f, 1.4f, 1.8f}), test::box({0.5f, 0.9f, 1.0f}, {0.9f, 1.4f, 1.5f}),
         test::box({1.1f, 0.4f, 1.2f}, {1.2f, 1.4f, 1.5f}),
         test::box({0.3f, 0.3f, 1.25f}, {0.5f, 0.7f, 1.5f})});
}

RigidTransform pose(const Vector3f& place, float turn_deg, const Vector3f& axis) {
    RigidTransform T_g_c = RigidTransform::Identity();
    T_g_c.translate(place);
    T_g_c.rotate(Eigen::AngleAxisf(turn_deg * 0.0174533f, axis.normalized()));
    return T_g_c;
}

VolumeConfig two_metres() {
    VolumeConfig config;
    config.size_vox = 128;
    config.side_m = 2.0f;
    return config;
}

class RelocalisationTest : public testing::Test {
  protected:
    RelocalisationTest() : chain(test::small_camera(160, 120), two_metres()) {
        for (int i = 0; i < 4; ++i) chain.fuse(seen_from(T_g_last), T_g_last);
    }
    std::vector<std::uint16_t> seen_from(const RigidTransform& T_g_c, const test::Surface& scene = corner()) {
        return test::to_mm(test::view_m(chain.k, scene, T_g_c));
    }
    /// The view as the live maps; not fused.
    DepthView show(std::vector<std::uint16_t> picture) {
        shown = std::move(picture);
        const DepthView view{shown, chain.k};
        conversion.convert(view, chain.live);
        return view;
    }
    std::optional<RigidTransform> search(const DepthView& view, int steps,
                                         const KeyframeDatabase* keyframes = nullptr) {
        for (int i = 0; i < steps; ++i) {
            auto found = relocalisation.step(chain.live, view, chain.volume, T_g_last, keyframes);
            // The place is found within ICP's reach; the next frames do the rest.
            for (int frame = 0; found && frame < 3; ++frame)
                found = relocalisation.confirm(chain.live, chain.volume, *found);
            if (found) return found;
        }
        return std::nullopt;
    }

    // Into the corner, so that none of its three sides is seen at a grazing angle.
    const RigidTransform T_g_last = pose({0.3f, 0.3f, 0.3f}, 35.0f, {0.0f, 1.0f, 0.0f}) *
                                    pose({0.f, 0.f, 0.f}, -33.0f, {1.0f, 0.0f, 0.0f});
    test::FusionChain chain;
    DepthMapConversion conversion{chain.device, {}, chain.k};
    Relocalisation relocalisation{chain.device, {}, chain.k};
    std::vector<std::uint16_t> shown;
};

/// A voxel is 16 mm, a pixel 8 mm at the wall: a place is known to a tenth of these.
void expect_near(const RigidTransform& found, const RigidTransform& truth) {
    const Displacement off = displacement(truth.inverse() * found);
    EXPECT_LT(off.shift_m, 0.003f);
    EXPECT_LT(off.turn_deg, 0.2f);
}

TEST_F(RelocalisationTest, FindsAKnockOfFiveDegreesAndFiftyMillimetres) {
    for (const Vector3f& axis : {Vector3f(1, 0, 0), Vector3f(0, 1, 0), Vector3f(-0.2f, -1, 1)}) {
        const RigidTransform T_g_c = T_g_last * pose(0.05f * axis.normalized(), 5.0f, axis);
        relocalisation.restart();
        const auto found = search(show(seen_from(T_g_c)), 30);
        ASSERT_TRUE(found) << axis.transpose();
        expect_near(*found, T_g_c);
    }
}

TEST_F(RelocalisationTest, AnotherSceneIsNoPlace) {
    const test::Surface wall = test::box({-1.f, -1.f, 0.9f}, {3.f, 3.f, 1.0f});
    EXPECT_FALSE(search(show(seen_from(T_g_last, wall)), 40));
    EXPECT_FALSE(search(show(std::vector<std::uint16_t>(160 * 120, 0)), 40));
}

TEST_F(RelocalisationTest, KeyframesLeadToWhereTheLastPoseDoesNot) {
    const RigidTransform T_g_far = pose({0.9f, 0.3f, 0.3f}, 0.0f, {0.0f, 1.0f, 0.0f}) *
                                   pose({0.f, 0.f, 0.f}, -33.0f, {1.0f, -0.1f, 0.0f});
    for (int i = 0; i < 4; ++i) chain.fuse(seen_from(T_g_far), T_g_far);
    KeyframeDatabase keyframes;
    keyframes.add_if_new(make_small_picture({shown = seen_from(T_g_far), chain.k}), T_g_far);
    const RigidTransform T_g_c = T_g_far * pose({0.01f, 0.0f, 0.02f}, 1.5f, {0.0f, 1.0f, 0.3f});
    const DepthView view = show(seen_from(T_g_c));
    EXPECT_FALSE(search(view, 40));
    relocalisation.restart();
    const auto found = search(view, 40, &keyframes);
    ASSERT_TRUE(found);
    expect_near(*found, T_g_c);
}

TEST_F(RelocalisationTest, RealignmentWaitsUntilTheCameraStandsStill) {
    Realignment realignment(chain.device, {}, chain.k);
    realignment.start(T_g_last);
    RigidTransform T_g_c = T_g_last;
    const auto step = [&] {
        const DepthView view = show(seen_from(T_g_c));
        return realignment.step(chain.live, view, chain.volume, nullptr);
    };
    for (int i = 0; i < 8; ++i) {
        T_g_c = T_g_c * pose({0.008f, 0.0f, 0.0f}, 0.5f, {0.0f, 1.0f, 0.0f});
        EXPECT_EQ(step(), Realignment::Outcome::searching) << "it moves in frame " << i;
    }
    int frames = 0;
    while (frames < 30 && step() == Realignment::Outcome::searching) ++frames;
    EXPECT_LT(frames, 20);
    expect_near(realignment.T_g_c(), T_g_c);
}

TEST_F(RelocalisationTest, RealignmentGivesUpButNotWhileTheCameraIsCovered) {
    RealignmentConfig config;
    config.most_frames = 5;
    Realignment realignment(chain.device, config, chain.k);
    realignment.start(T_g_last);
    const DepthView covered = show(std::vector<std::uint16_t>(160 * 120, 0));
    for (int i = 0; i < 20; ++i)
        EXPECT_EQ(realignment.step(chain.live, covered, chain.volume, nullptr),
                  Realignment::Outcome::searching);
    const DepthView other = show(seen_from(T_g_last, test::box({-1.f, -1.f, 0.9f}, {3.f, 3.f, 1.0f})));
    int frames = 0;
    while (realignment.step(chain.live, other, chain.volume, nullptr) == Realignment::Outcome::searching)
        ASSERT_LT(++frames, 10);
    EXPECT_EQ(frames, 5);
}

}  // namespace
}  // namespace touchstone
