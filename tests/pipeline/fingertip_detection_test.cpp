#include "pipeline/fingertip_detection.hpp"

#include <gtest/gtest.h>

#include "tests/support/finger_scene.hpp"

namespace touchstone {
namespace {

using Eigen::Vector3f;

/// A sensor without a matching window: edges are where they are.
FingertipDetectionConfig exact_sensor() {
    FingertipDetectionConfig config;
    config.measurement.radius_bias_px = 0.0f;
    config.measurement.outline_loss_px = 0.0f;
    return config;
}

std::vector<FingertipCandidate> detect(test::FingerScene& scene) {
    scene.finish();
    const std::vector<PixelRegion> regions{scene.whole()};
    return detect_fingertips(scene.picture(), regions, {}, exact_sensor());
}

struct Case {
    const char* name;
    test::Ground ground;
    Vector3f touched_m, normal;
};

void PrintTo(const Case& tested, std::ostream* out) { *out << tested.name; }

/// A place on a surface, `u` metres to the right and `v` metres down from the middle of the picture.
Case on_plane(const char* name, float tilt_rad, float u, float v) {
    const Vector3f away(0.0f, std::sin(tilt_rad), std::cos(tilt_rad));
    const test::Ground ground = test::plane_ground(away, 1.0f * away.z());
    const Vector3f touched(u, v, (away.z() - away.y() * v) / away.z());
    return {name, ground, touched, -away};
}
Case on_ball() {
    const Vector3f center(0.01f, 0.02f, 1.16f), normal = Vector3f(0.25f, -0.1f, -1.0f).normalized();
    return {"ball", test::ball_ground(center, 0.16f), center + 0.16f * normal, normal};
}
Case in_bowl() {
    const Vector3f center(0.0f, 0.0f, 0.8f), normal = Vector3f(-0.2f, 0.2f, -1.0f).normalized();
    return {"bowl", test::bowl_ground(center, 0.23f), center - 0.23f * normal, normal};
}

class Surfaces : public testing::TestWithParam<Case> {
  protected:
    const Case place = GetParam();
    const Vector3f axis = Vector3f(0.75f, 0.25f, -0.65f).normalized();
    test::FingerScene scene{place.ground};

    const FingertipCandidate* at_place(const std::vector<FingertipCandidate>& tips) const {
        const FingertipCandidate* nearest = nullptr;
        for (const FingertipCandidate& tip : tips)
            if ((tip.surface_c_m - place.touched_m).norm() < 0.015f) nearest = &tip;
        return nearest;
    }
};

TEST_P(Surfaces, ATouchIsWhereThePadIsWithinAMillimetre) {
    scene.add_hand(place.touched_m, place.normal, axis, 0.008f, 0.0f);
    const auto tips = detect(scene);
    const FingertipCandidate* tip = at_place(tips);
    ASSERT_NE(tip, nullptr);
    EXPECT_EQ(std::ranges::count_if(tips, [](const auto& t) { return t.height_m < 0.01f; }), 1);
    EXPECT_LT((tip->surface_c_m - place.touched_m).norm(), 1.0e-3f);
    EXPECT_NEAR(tip->height_m, 0.0f, 1.0e-3f);
    EXPECT_NEAR(tip->shape.radius_m, 0.008f, 0.5e-3f);
}

TEST_P(Surfaces, AHoverHasItsHeightWithinAMillimetre) {
    scene.add_hand(place.touched_m, place.normal, axis, 0.007f, 0.03f);
    const auto tips = detect(scene);
    const FingertipCandidate* tip = at_place(tips);
    ASSERT_NE(tip, nullptr);
    EXPECT_NEAR(tip->height_m, 0.03f, 1.0e-3f);
    EXPECT_LT((tip->surface_c_m - place.touched_m).norm(), 1.5e-3f);
}

TEST_P(Surfaces, TheSensorsNoiseCostsTwoMillimetresOnAverage) {
    float place_sum_m = 0.0f, height_sum_m = 0.0f;
    int found = 0;
    for (unsigned seed = 1; seed <= 12; ++seed) {
        test::FingerScene noisy(place.ground);
        noisy.add_hand(place.touched_m, place.normal, axis, 0.008f, 0.0f);
        noisy.add_noise(seed);
        const auto tips = detect(noisy);
        const FingertipCandidate* tip = at_place(tips);
        if (tip == nullptr) continue;
        ++found;
        place_sum_m += (tip->surface_c_m - place.touched_m).norm();
        height_sum_m += std::abs(tip->height_m);
    }
    EXPECT_GE(found, 11);
    EXPECT_LT(place_sum_m, 0.002f * static_cast<float>(found));
    EXPECT_LT(height_sum_m, 0.002f * static_cast<float>(found));
}

INSTANTIATE_TEST_SUITE_P(Fingertips, Surfaces,
                         testing::Values(on_plane("facing", 0.0f, 0.02f, 0.01f),
                                         on_plane("tilted30", 0.5236f, -0.03f, 0.02f), on_ball(), in_bowl()),
                         [](const auto& tested) { return tested.param.name; });

class Table : public testing::Test {
  protected:
    const Case place = on_plane("table", 0.4363f, 0.0f, 0.0f);
    const Vector3f n = place.normal;
    const Vector3f right{1.0f, 0.0f, 0.0f};
    const Vector3f nearer = n.cross(right);  ///< on the table, down in the picture
    test::FingerScene scene{place.ground};

    Vector3f on_table(float u, float v, float height_m) const {
        return place.touched_m + u * right + v * nearer + height_m * n;
    }
    void expect_no_contact(const char* what) {
        for (const FingertipCandidate& tip : detect(scene)) EXPECT_GT(tip.height_m, 0.010f) << what;
    }
};

TEST_F(Table, TwoFingers35MillimetresApartAreTwo) {
    for (const float side : {-0.0175f, 0.0175f}) {
        const Vector3f tip = on_table(side, -0.03f, 0.008f);
        scene.add({tip, tip + 0.04f * nearer + 0.05f * n, 0.008f, 0.010f});
        scene.add({tip + 0.04f * nearer + 0.05f * n, on_table(0.0f, 0.08f, 0.09f), 0.010f, 0.03f});
    }
    const auto tips = detect(scene);
    int touching = 0;
    for (const FingertipCandidate& tip : tips) touching += tip.height_m < 0.003f;
    EXPECT_EQ(touching, 2);
}

TEST_F(Table, APalmLyingFlatIsNoTouch) {
    for (const float u : {-0.03f, -0.01f, 0.01f, 0.03f})
        scene.add({on_table(u, -0.03f, 0.014f), on_table(u, 0.05f, 0.016f), 0.014f, 0.016f});
    expect_no_contact("palm");
}

TEST_F(Table, AForearmIsNoTouch) {
    scene.add({on_table(-0.05f, -0.05f, 0.032f), on_table(0.12f, 0.09f, 0.042f), 0.03f, 0.04f});
    expect_no_contact("forearm");
}

TEST_F(Table, ABallIsNoTouch) {
    scene.add({on_table(0.0f, 0.0f, 0.03f), on_table(0.0f, 0.001f, 0.03f), 0.03f, 0.03f});
    expect_no_contact("ball");
}

TEST_F(Table, ABoxIsNoTouch) {
    const test::DepthOfRay top = test::plane(-n, -n.dot(place.touched_m) - 0.02f);
    scene.add_depth([&](const Vector3f& ray) {
        const Vector3f p = top(ray) * ray - place.touched_m;
        return std::abs(p.dot(right)) < 0.04f && std::abs(p.dot(nearer)) < 0.03f ? top(ray) : 0.0f;
    });
    expect_no_contact("box");
}

TEST_F(Table, AFingerWithoutAHandIsNone) {
    scene.add({on_table(0.0f, 0.0f, 0.008f), on_table(0.03f, 0.0f, 0.02f), 0.008f, 0.008f});
    EXPECT_TRUE(detect(scene).empty());
}

TEST_F(Table, NothingIsFoundOutsideTheRegions) {
    scene.add_hand(place.touched_m, n, (nearer + 0.8f * n).normalized(), 0.008f, 0.0f);
    scene.finish();
    const std::vector<PixelRegion> aside{{0, 0, 40, 200}};
    EXPECT_TRUE(detect_fingertips(scene.picture(), aside, {}, exact_sensor()).empty());
    EXPECT_TRUE(detect_fingertips(scene.picture(), {}, {}, exact_sensor()).empty());
}

TEST_F(Table, OverlappingRegionsDoNotDoubleAFinger) {
    scene.add_hand(place.touched_m, n, (nearer + 0.8f * n).normalized(), 0.008f, 0.0f);
    scene.finish();
    const std::vector<PixelRegion> regions{scene.whole(), {20, 20, 200, 180}, {60, 0, 220, 200}};
    EXPECT_EQ(detect_fingertips(scene.picture(), regions, {}, exact_sensor()).size(), 1u);
}

TEST_F(Table, HandsInRegionsOfTheirOwnAreBothFound) {
    for (const float side : {-0.12f, 0.12f})
        scene.add_hand(on_table(side, 0.0f, 0.0f), n, (nearer + 0.8f * n).normalized(), 0.008f, 0.0f);
    scene.finish();
    const PixelRegion whole = scene.whole();
    const int middle_px = (whole.x0 + whole.x1) / 2;
    const std::vector<PixelRegion> regions{{whole.x0, whole.y0, middle_px, whole.y1},
                                           {middle_px, whole.y0, whole.x1, whole.y1}};
    EXPECT_EQ(detect_fingertips(scene.picture(), regions, {}, exact_sensor()).size(), 2u);
}

TEST_F(Table, LostMiddleOfAFingerDoesNotMoveItsTip) {
    scene.add_hand(place.touched_m, n, (nearer + 0.8f * n).normalized(), 0.008f, 0.0f);
    const Vector3f lost = place.touched_m + 0.045f * (nearer + 0.8f * n).normalized();
    const int cut_y = static_cast<int>(lost.y() / lost.z() * scene.k.fy_px + scene.k.cy_px);
    for (int x = 0; x < scene.k.width_px; ++x) scene.live_m[scene.background.index(x, cut_y)] = 0.0f;
    scene.finish();
    const std::vector<PixelRegion> regions{scene.whole()};
    const std::vector<KnownFinger> known{
        {{place.touched_m + 0.008f * n, (nearer + 0.8f * n).normalized(), 0.008f}, {}, 0.2f}};
    const auto tips = detect_fingertips(scene.picture(), regions, known, exact_sensor());
    ASSERT_FALSE(tips.empty());
    EXPECT_LT((tips[0].surface_c_m - place.touched_m).norm(), 1.5e-3f);
}

}  // namespace
}  // namespace touchstone
