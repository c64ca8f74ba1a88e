#include "pipeline/foreground_segmentation.hpp"

#include <gtest/gtest.h>
#include <numbers>
#include <random>

#include "pipeline/depth_map_conversion.hpp"
#include "tests/support/analytic_scene.hpp"
#include "tests/support/map_access.hpp"
#include "tests/support/structured_light_noise.hpp"

namespace touchstone {
namespace {

using test::DepthOfRay;

/// A camera of Kinect angles with fewer pixels rows, 1 m above a table that is tilted by 30 degrees.
const Intrinsics kinect{575.8f, 575.8f, 159.5f, 119.5f, 320, 240, {0, 0}};
const Eigen::Vector3f table_normal = Eigen::Vector3f(0.0f, 0.5f, std::sqrt(0.75f));
constexpr float table_distance_m = 0.9f;

DepthOfRay table() { return test::plane(table_normal, table_distance_m); }

/// A finger of 16 mm across: ball after ball along the table, its lower side at a height over the table.
DepthOfRay finger(float height_m) {
    DepthOfRay all = [](const Eigen::Vector3f&) { return 0.0f; };
    const Eigen::Vector3f along = Eigen::Vector3f::UnitX();
    const Eigen::Vector3f start = Eigen::Vector3f(-0.12f, 0.0f, table_distance_m / table_normal.z()) -
                                  (height_m + 0.008f) * table_normal;
    for (int i = 0; i < 24; ++i)
        all = test::both(all, test::sphere(start + 0.005f * static_cast<float>(i) * along, 0.008f));
    return all;
}

/// A box of 20 cm x 16 cm x 10 cm that stands in front of the camera, as its front face and what it hides.
DepthOfRay box_front(float depth_m) {
    return [=](const Eigen::Vector3f& ray) {
        const Eigen::Vector3f p = depth_m * ray;
        return std::abs(p.x()) < 0.1f && std::abs(p.y() - 0.02f) < 0.08f ? depth_m : 0.0f;
    };
}

class Stage {
  public:
    explicit Stage(const Intrinsics& k = kinect, const ForegroundSegmentationConfig& config = {})
        : k_(k),
          device_(DeviceConfig{}),
          conversion_(device_, {}, k),
          live_(device_, make_map_shape(k)),
          background_(device_, live_.shape),
          segmentation_(device_, config, k) {
        background_.depth_m.fill(0.0f);
        background_.normals_c.fill(0.0f);
    }

    /// The model as a long scan would give it: exact.
    void set_background(const DepthOfRay& surface) {
        const std::vector<float> depth_m = test::render_depth_m(k_, surface);
        background_.depth_m.write(test::padded<float>(live_.shape, depth_m));
    }
    void learn(const std::vector<std::uint16_t>& depth_mm) {
        conversion_.convert({depth_mm, k_}, live_);
        segmentation_.learn(live_, background_);
    }
    const Foreground& segment(const std::vector<std::uint16_t>& depth_mm) {
        conversion_.convert({depth_mm, k_}, live_);
        const Foreground& foreground = segmentation_.segment(live_, background_);
        segmentation_.mask_background(live_, background_);
        return foreground;
    }
    std::vector<std::uint16_t> sense(const DepthOfRay& surface) {
        return test::sense(sensor_, k_, test::render_depth_m(k_, surface), random_);
    }
    std::vector<std::uint8_t> picture(const Buffer<std::uint8_t>& map) const {
        return test::cropped(live_.shape, map.read());
    }

  private:
    Intrinsics k_;
    Device device_;
    DepthMapConversion conversion_;
    LiveMaps live_;
    SurfacePrediction background_;
    ForegroundSegmentation segmentation_;
    test::StructuredLight sensor_;
    std::mt19937 random_{11};
};

std::size_t marked(const std::vector<std::uint8_t>& mask) {
    return static_cast<std::size_t>(std::ranges::count_if(mask, [](std::uint8_t m) { return m != 0; }));
}

struct Overlap {
    std::size_t both = 0, truth = 0, found = 0;
    double iou() const { return static_cast<double>(both) / static_cast<double>(truth + found - both); }
};

/// Over the pixels with a reading.
Overlap compare(const std::vector<std::uint8_t>& mask, const DepthOfRay& object,
                const std::vector<std::uint16_t>& depth_mm) {
    Overlap overlap;
    const std::vector<float> behind = test::render_depth_m(kinect, table());
    const std::vector<float> object_m = test::render_depth_m(kinect, object);
    for (std::size_t i = 0; i < mask.size(); ++i) {
        if (depth_mm[i] == 0) continue;
        const bool truth = object_m[i] > 0.0f && object_m[i] < behind[i];
        overlap.truth += truth;
        overlap.found += mask[i] != 0;
        overlap.both += truth && mask[i] != 0;
    }
    return overlap;
}

TEST(ForegroundSegmentation, ANoisyTableAloneGivesNothing) {
    Stage stage;
    stage.set_background(table());
    for (int frame = 0; frame < 20; ++frame) {
        const Foreground& foreground = stage.segment(stage.sense(table()));
        EXPECT_TRUE(foreground.components.empty()) << frame;
        EXPECT_EQ(marked(stage.picture(foreground.mask)), 0u) << frame;
    }
}

class FingerHeight : public testing::TestWithParam<int> {};

/// From a finger that lies on the table (its top is 16 mm above it) to one at 30 cm: found in each of 10
/// frames, and its area is right to 70 % when it lies and to 85 % from 1 cm on.
TEST_P(FingerHeight, IsOneComponentOfItsShape) {
    Stage stage;
    stage.set_background(table());
    const DepthOfRay object = finger(static_cast<float>(GetParam()) * 0.001f);
    for (int frame = 0; frame < 10; ++frame) {
        const std::vector<std::uint16_t> depth_mm = stage.sense(test::both(table(), object));
        const Foreground& foreground = stage.segment(depth_mm);
        ASSERT_EQ(foreground.components.size(), 1u) << frame;
        const Overlap overlap = compare(stage.picture(foreground.mask), object, depth_mm);
        EXPECT_GT(overlap.iou(), GetParam() < 10 ? 0.7 : 0.85) << frame;
        EXPECT_EQ(static_cast<std::size_t>(foreground.components[0].pixels), overlap.found) << frame;
    }
}

INSTANTIATE_TEST_SUITE_P(Millimetres, FingerHeight, testing::Values(0, 10, 20, 50, 150, 300));

/// The edges of a still box jump by a pixel or two from frame to frame, in both directions.
TEST(ForegroundSegmentation, FlickeringEdgesOfStillThingsAreBackground) {
    Stage stage;
    const DepthOfRay scene = test::both(table(), box_front(0.7f));
    stage.set_background(scene);
    for (int frame = 0; frame < 5; ++frame) {
        for (const float shift_px : {-1.5f, 1.5f}) {
            const DepthOfRay moved = [&](const Eigen::Vector3f& ray) {
                const Eigen::Vector3f from =
                    ray + Eigen::Vector3f(shift_px / 575.8f, shift_px / 575.8f, 0.0f);
                return test::both(table(),
                                  [&](const Eigen::Vector3f&) { return box_front(0.7f)(from); })(ray);
            };
            const Foreground& foreground = stage.segment(stage.sense(moved));
            EXPECT_TRUE(foreground.components.empty()) << frame;
        }
    }
}

/// What was in front and is gone shows the surface behind it: that is for the background to learn.
TEST(ForegroundSegmentation, AThingTakenAwayIsNotForeground) {
    Stage stage;
    stage.set_background(test::both(table(), box_front(0.7f)));
    const Foreground& foreground = stage.segment(stage.sense(table()));
    EXPECT_TRUE(foreground.components.empty());
    EXPECT_EQ(marked(stage.picture(foreground.background_mask)), 0u);
    const std::vector<std::uint8_t> codes = stage.picture(foreground.rejection);
    EXPECT_GT(std::ranges::count(codes, ASSOCIATION_BEHIND), 15000);
}

/// A person in front of a wall that is out of range, with nothing behind to compare with.
TEST(ForegroundSegmentation, APersonInFrontOfTheUnknownIsForeground) {
    Stage stage;
    const DepthOfRay person = box_front(1.2f);
    const Foreground& foreground = stage.segment(stage.sense(person));
    ASSERT_EQ(foreground.components.size(), 1u);
    EXPECT_NEAR(foreground.components[0].mean_depth_m, 1.2f, 0.005f);
}

/// Where the sensor sees nothing but for a few pixels now and then, in a hole of the model.
TEST(ForegroundSegmentation, AHoleThatFlickersIsBackground) {
    Stage stage;
    const auto is_hole = [](const Eigen::Vector3f& ray) { return std::hypot(ray.x(), ray.y()) < 0.08f; };
    const DepthOfRay holed = [&](const Eigen::Vector3f& ray) { return is_hole(ray) ? 0.0f : table()(ray); };
    stage.set_background(holed);
    std::mt19937 random(4);
    for (int frame = 0; frame < 10; ++frame) {
        const float x = 0.0001f * static_cast<float>(random() % 1000) - 0.05f;
        const DepthOfRay flicker = [&](const Eigen::Vector3f& ray) {
            const bool seen = std::hypot(ray.x() - x, ray.y()) < 0.012f;
            return is_hole(ray) && !seen ? 0.0f : table()(ray);
        };
        EXPECT_TRUE(stage.segment(stage.sense(flicker)).components.empty()) << frame;
    }
}

/// Outside the volume there is never a model: what the scan saw there is remembered instead.
TEST(ForegroundSegmentation, WhatTheScanSawOutsideTheVolumeIsBackground) {
    Stage stage;
    for (int frame = 0; frame < 10; ++frame) stage.learn(stage.sense(table()));
    EXPECT_TRUE(stage.segment(stage.sense(table())).components.empty());
    const Foreground& foreground = stage.segment(stage.sense(test::both(table(), finger(0.05f))));
    EXPECT_EQ(foreground.components.size(), 1u);
}

TEST(ForegroundSegmentation, TheBackgroundsMaskIsWiderAndOutlivesTheForeground) {
    ForegroundSegmentationConfig config;
    config.widen_px = 6;
    config.hold_frames = 3;
    Stage stage(kinect, config);
    stage.set_background(table());
    const Foreground& foreground = stage.segment(stage.sense(test::both(table(), finger(0.1f))));
    const std::vector<std::uint8_t> mask = stage.picture(foreground.mask);
    const std::vector<std::uint8_t> wide = stage.picture(foreground.background_mask);
    ASSERT_GT(marked(mask), 500u);
    for (int y = 0; y < kinect.height_px; ++y) {
        for (int x = 0; x < kinect.width_px; ++x) {
            bool near = false;
            for (int j = std::max(0, y - 6); j <= std::min(kinect.height_px - 1, y + 6); ++j) {
                for (int i = std::max(0, x - 6); i <= std::min(kinect.width_px - 1, x + 6); ++i)
                    near |= mask[static_cast<std::size_t>(j * kinect.width_px + i)] != 0;
            }
            ASSERT_EQ(wide[static_cast<std::size_t>(y * kinect.width_px + x)], near ? 255 : 0)
                << x << " " << y;
        }
    }
    for (int frame = 1; frame <= 4; ++frame) {
        stage.segment(stage.sense(table()));
        EXPECT_EQ(marked(stage.picture(foreground.mask)), 0u);
        EXPECT_EQ(marked(stage.picture(foreground.background_mask)), frame <= 3 ? marked(wide) : 0u) << frame;
    }
}

/// A ball of 3 cm across on nothing, where there was none: believed in the second frame, kept from the
/// background in the first.
TEST(ForegroundSegmentation, WhatAppearsSmallAndAloneIsBelievedInItsSecondFrame) {
    Stage stage;
    stage.set_background(table());
    const DepthOfRay ball = test::sphere(Eigen::Vector3f(0.05f, 0.0f, 0.85f), 0.015f);
    const Foreground& foreground = stage.segment(stage.sense(test::both(table(), ball)));
    EXPECT_TRUE(foreground.components.empty());
    EXPECT_EQ(marked(stage.picture(foreground.mask)), 0u);
    EXPECT_GT(marked(stage.picture(foreground.background_mask)), 300u);
    for (int frame = 1; frame < 10; ++frame)
        EXPECT_EQ(stage.segment(stage.sense(test::both(table(), ball))).components.size(), 1u) << frame;
}

/// A spot that the sensor puts somewhere else in each frame is never believed.
TEST(ForegroundSegmentation, SpotsOfOneFrameAreNot) {
    Stage stage;
    stage.set_background(table());
    for (int frame = 0; frame < 12; ++frame) {
        const float x_m = -0.2f + 0.1f * static_cast<float>(frame * 2 % 5);
        const float y_m = -0.12f + 0.1f * static_cast<float>(frame % 3);
        const DepthOfRay ball = test::sphere(Eigen::Vector3f(x_m, y_m, 0.8f), 0.015f);
        EXPECT_TRUE(stage.segment(stage.sense(test::both(table(), ball))).components.empty()) << frame;
    }
}

/// Nor is a spot that comes back where it was a few frames before: of late is the frame before.
TEST(ForegroundSegmentation, ASpotThatComesBackNowAndThenIsNot) {
    Stage stage;
    stage.set_background(table());
    const DepthOfRay ball = test::sphere(Eigen::Vector3f(0.05f, 0.0f, 0.85f), 0.015f);
    for (int frame = 0; frame < 12; ++frame) {
        const bool there = frame % 3 == 0;
        EXPECT_TRUE(
            stage.segment(stage.sense(there ? test::both(table(), ball) : table())).components.empty())
            << frame;
    }
}

/// A piece that noise broke off a hand is believed at once.
TEST(ForegroundSegmentation, APieceBesideTheForegroundIsBelieved) {
    Stage stage;
    stage.set_background(table());
    const DepthOfRay ball = test::sphere(Eigen::Vector3f(0.11f, 0.0f, 0.82f), 0.015f);
    const DepthOfRay both = test::both(box_front(0.7f), ball);
    EXPECT_EQ(stage.segment(stage.sense(test::both(table(), both))).components.size(), 2u);
}

TEST(ForegroundSegmentation, EmptyFramesAndOddSizes) {
    for (const auto& [width, height] : {std::pair{1, 1}, {17, 9}, {160, 120}}) {
        const Intrinsics k = test::small_camera(width, height);
        Stage stage(k);
        const std::vector<std::uint16_t> nothing(static_cast<std::size_t>(width * height), 0);
        const std::vector<std::uint16_t> too_far(nothing.size(), 65535);
        EXPECT_TRUE(stage.segment(nothing).components.empty());
        EXPECT_TRUE(stage.segment(too_far).components.empty());
        stage.set_background(test::plane(Eigen::Vector3f::UnitZ(), 1.0f));
        EXPECT_TRUE(stage.segment(nothing).components.empty());
        const Foreground& covered = stage.segment(std::vector<std::uint16_t>(nothing.size(), 500));
        const bool large_enough = width * height >= 40;
        EXPECT_EQ(marked(stage.picture(covered.mask)), large_enough ? nothing.size() : 0u) << width;
    }
}

/// Holes of one pixel in the live picture and in the model do not tear a hand.
TEST(ForegroundSegmentation, HolesOfOnePixel) {
    Stage stage;
    std::mt19937 random(8);
    stage.set_background(
        [&](const Eigen::Vector3f& ray) { return random() % 10 == 0 ? 0.0f : table()(ray); });
    std::vector<std::uint16_t> depth_mm = stage.sense(test::both(table(), finger(0.05f)));
    for (std::uint16_t& mm : depth_mm) mm = random() % 10 == 0 ? std::uint16_t{0} : mm;
    EXPECT_EQ(stage.segment(depth_mm).components.size(), 1u);
}

}  // namespace
}  // namespace touchstone
