#include "pipeline/foreground_model.hpp"

#include <gtest/gtest.h>

#include "tests/support/moving_things.hpp"

namespace touchstone {
namespace {

using test::moved;

/// Camera to a thing that was 0.8 m away, `x_m` to the right, and moved and turned about itself since.
RigidTransform seen_from(float x_m, const RigidTransform& movement = RigidTransform::Identity()) {
    RigidTransform T_c_o = RigidTransform::Identity();
    T_c_o.translation() = Eigen::Vector3f(x_m, 0.0f, 0.8f);
    return (T_c_o * movement).inverse();
}

class ForegroundModelTest : public testing::Test {
  protected:
    const SurfacePrediction& show(const std::vector<RigidTransform>& T_o_c, float noise_m = 0.0f) {
        things.show(T_o_c, noise_m);
        return model.update(things.live, things.foreground);
    }
    std::vector<float> surface_m() const {
        return test::cropped(model.surface().shape, model.surface().depth_m.read());
    }
    std::vector<std::uint8_t> source() const {
        return test::cropped(model.surface().shape, model.source().read());
    }

    Device device{DeviceConfig{}};
    Intrinsics k = test::small_camera(320, 240);
    ForegroundModel model{device, {}, k};
    test::MovingThings things{device, k};
};

/// 9 mm and 2 degrees a frame, 20 frames: within 2 mm and 0.7 degrees of the truth in the end.
TEST_F(ForegroundModelTest, FollowsAThingThatMovesAndTurns) {
    const RigidTransform start = seen_from(-0.08f);
    show({start});
    const RigidTransform T_g_first = model.volumes()[0].T_g_c();
    RigidTransform T_o_c = start;
    for (int frame = 1; frame <= 20; ++frame) {
        const auto t = static_cast<float>(frame);
        T_o_c = seen_from(-0.08f, moved({8.0f * t, -3.0f * t, 2.0f * t}, 2.0f * t));
        show({T_o_c});
    }
    ASSERT_EQ(model.volumes().size(), 1u);
    EXPECT_EQ(model.volumes()[0].frames, 21) << "it was never lost";
    const test::PoseError error =
        test::pose_error(T_g_first.inverse() * model.volumes()[0].T_g_c(), start.inverse() * T_o_c);
    EXPECT_LT(error.mm, 2.0f);
    EXPECT_LT(error.deg, 0.7f);
}

TEST_F(ForegroundModelTest, IsSmootherThanTheMeasurementWhileItMoves) {
    for (int frame = 0; frame < 20; ++frame) {
        const auto t = static_cast<float>(frame);
        show({seen_from(0.0f, moved({4.0f * t, -2.0f * t, 1.0f * t}, 1.0f * t))}, 0.0015f);
    }
    const std::vector<float> shown_m = surface_m(),
                             live_m = test::cropped(things.live.shape, things.live.depth_m.read());
    const std::vector<std::uint8_t> from = source();
    double shown = 0.0, live = 0.0;
    int modelled = 0, pixels = 0;
    for (std::size_t i = 0; i < shown_m.size(); ++i) {
        pixels += things.exact_m[i] > 0.0f;
        // Where nothing was measured beside the thing, its model may go on.
        if (from[i] != FOREGROUND_MODEL || things.exact_m[i] <= 0.0f) continue;
        ++modelled;
        shown += std::pow(shown_m[i] - things.exact_m[i], 2.0);
        live += std::pow(live_m[i] - things.exact_m[i], 2.0);
    }
    EXPECT_GT(modelled, pixels * 3 / 4);
    EXPECT_LT(shown, live / 4.0) << "half the noise: a quarter of the squares";
}

/// What moves 50 mm at once without its pose being found is shown as measured until its model has caught up.
TEST_F(ForegroundModelTest, NothingDisappearsAndNothingStaysBehind) {
    for (int frame = 0; frame < 6; ++frame) show({seen_from(0.0f)});
    for (int frame = 0; frame < 3; ++frame) {
        show({seen_from(0.0f, moved({50.0f, 0.0f, 30.0f}))});
        const std::vector<float> shown_m = surface_m();
        for (std::size_t i = 0; i < shown_m.size(); ++i) {
            if (things.exact_m[i] <= 0.0f) continue;
            ASSERT_GT(shown_m[i], 0.0f) << i;
            ASSERT_LT(std::abs(shown_m[i] - things.exact_m[i]), 0.007f) << i;
        }
    }
}

TEST_F(ForegroundModelTest, TwoThingsHaveVolumesOfTheirOwn) {
    int first_id = -1, second_id = -1;
    for (int frame = 0; frame < 10; ++frame) {
        const RigidTransform left = seen_from(-0.2f, moved({-5.0f * static_cast<float>(frame), 0.0f, 0.0f}));
        const RigidTransform right = seen_from(0.2f, moved({0.0f, 4.0f * static_cast<float>(frame), 0.0f}));
        // What is first is not the same in each frame.
        const bool swapped = frame % 2 == 1;
        show(swapped ? std::vector{right, left} : std::vector{left, right});
        ASSERT_EQ(model.volumes().size(), 2u);
        for (const MovingVolume& volume : model.volumes()) {
            int& id = volume.last_centre_c_m.x() < 0.0f ? first_id : second_id;
            if (id < 0) id = volume.id();
            EXPECT_EQ(id, volume.id());
        }
    }
    EXPECT_NE(first_id, second_id);
}

TEST_F(ForegroundModelTest, VolumesGoWithTheirComponents) {
    const int outlives = ForegroundModelConfig{}.missing_frames;
    show({seen_from(-0.2f), seen_from(0.2f)});
    for (int frame = 0; frame < outlives; ++frame) show({seen_from(0.2f)});
    EXPECT_EQ(model.volumes().size(), 2u);
    show({seen_from(0.2f)});
    ASSERT_EQ(model.volumes().size(), 1u);
    EXPECT_GT(model.volumes()[0].last_centre_c_m.x(), 0.0f);
    for (int frame = 0; frame <= outlives; ++frame) show({});
    EXPECT_TRUE(model.volumes().empty());
    EXPECT_EQ(std::ranges::count(source(), FOREGROUND_NONE), 320 * 240);
}

TEST_F(ForegroundModelTest, MoreThingsThanVolumesAreShownAsMeasured) {
    ForegroundModelConfig config;
    config.most_volumes = 1;
    model = ForegroundModel(device, config, k);
    for (int frame = 0; frame < 3; ++frame) show({seen_from(-0.2f), seen_from(0.2f)});
    EXPECT_EQ(model.volumes().size(), 1u);
    const std::vector<float> shown_m = surface_m();
    for (std::size_t i = 0; i < shown_m.size(); ++i)
        ASSERT_TRUE(shown_m[i] > 0.0f || things.exact_m[i] <= 0.0f) << i;
}

TEST_F(ForegroundModelTest, SmallComponentsHaveNoVolume) {
    ForegroundModelConfig config;
    config.min_pixels = 1000000;
    model = ForegroundModel(device, config, k);
    show({seen_from(0.0f)});
    EXPECT_TRUE(model.volumes().empty());
    EXPECT_GT(std::ranges::count(source(), FOREGROUND_LIVE), 1000);
}

}  // namespace
}  // namespace touchstone
