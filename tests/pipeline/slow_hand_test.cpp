#include <gtest/gtest.h>
#include <optional>
#include <random>

#include "pipeline/background_model.hpp"
#include "pipeline/column_drift.hpp"
#include "pipeline/depth_map_conversion.hpp"
#include "pipeline/foreground_segmentation.hpp"
#include "tests/support/analytic_scene.hpp"
#include "tests/support/map_access.hpp"
#include "tests/support/structured_light_noise.hpp"

namespace touchstone {
namespace {

const Intrinsics kinect{287.9f, 287.9f, 79.5f, 59.5f, 160, 120, {0, 0}};
constexpr float table_m = 0.9f;

test::DepthOfRay table() { return test::plane(Eigen::Vector3f::UnitZ(), table_m); }

/// A flat hand of 10 cm x 18 cm and 25 mm thick, its lower side at a height over the table, as its upper side
/// and what that hides.
test::DepthOfRay hand(float height_m) {
    return [=](const Eigen::Vector3f& ray) {
        const float z_m = table_m - height_m - 0.025f;
        const Eigen::Vector3f p = z_m * ray;
        return std::abs(p.x()) < 0.05f && std::abs(p.y()) < 0.09f ? z_m : 0.0f;
    };
}

/// The live loop of the fixed camera: segmentation, drift and the background that goes on.
class LiveLoop {
  public:
    LiveLoop() {
        sensor_.column_shift_steps.assign(static_cast<std::size_t>(kinect.width_px), 0.0f);
        for (int frame = 0; frame < 20; ++frame) {
            const std::vector<std::uint16_t> depth_mm = sense(table());
            conversion_.convert({depth_mm, kinect}, live_);
            if (!background_) background_.emplace(device_, config(), kinect, VolumePlacement{1.0f, T_g_c()});
            background_->scan(live_);
            segmentation_.learn(live_, background_->prediction());
        }
    }

    /// Pixels of the foreground's mask.
    long process(const test::DepthOfRay& scene) {
        const std::vector<std::uint16_t> depth_mm = sense(scene);
        conversion_.convert({depth_mm, kinect}, live_);
        const Foreground& foreground = segmentation_.segment(live_, background_->prediction());
        segmentation_.mask_background(live_, background_->prediction());
        const std::vector<std::uint8_t> mask = foreground.mask.read();
        conversion_.set_column_shift(drift_.update(live_, background_->prediction(), foreground));
        background_->follow(live_, foreground.background_mask);
        return std::ranges::count(mask, 255);
    }
    void drift_by(float steps) {
        for (float& shift : sensor_.column_shift_steps) shift += steps;
    }

  private:
    std::vector<std::uint16_t> sense(const test::DepthOfRay& scene) {
        return test::sense(sensor_, kinect, test::render_depth_m(kinect, scene), random_);
    }
    static RigidTransform T_g_c() { return RigidTransform(Eigen::Translation3f(0.5f, 0.5f, 0.5f - table_m)); }
    static BackgroundConfig config() {
        BackgroundConfig config;
        config.volume.size_vox = 128;
        return config;
    }

    test::StructuredLight sensor_;
    std::mt19937 random_{5};
    Device device_{DeviceConfig{}};
    DepthMapConversion conversion_{device_, {}, kinect};
    LiveMaps live_{device_, make_map_shape(kinect)};
    ForegroundSegmentation segmentation_{device_, {}, kinect};
    ColumnDrift drift_{device_, {}, kinect};
    std::optional<BackgroundModel> background_;
};

/// Pixels of a hand that lies on the table.
long hand_pixels() {
    const std::vector<float> depth_m = test::render_depth_m(kinect, hand(0.0f));
    return std::ranges::count_if(depth_m, [](float z) { return z > 0.0f; });
}

/// A hand that comes down from 30 cm in 20 s, while the sensor drifts by a step of disparity, and then rests
/// on the table for 10 s is neither taken for drift nor fused into the background; when it has gone nothing
/// of it is left.
TEST(SlowHand, StaysForegroundAndLeavesNothing) {
    LiveLoop loop;
    const long whole = hand_pixels();
    constexpr int down_frames = 600, rest_frames = 300;
    for (int frame = 0; frame < down_frames + rest_frames; ++frame) {
        const float share = static_cast<float>(frame) / static_cast<float>(down_frames);
        if (frame % 6 == 0 && frame < down_frames) loop.drift_by(0.01f);
        const long marked = loop.process(test::both(table(), hand(0.3f * std::max(0.0f, 1.0f - share))));
        ASSERT_GT(marked, 4 * whole / 5) << frame;
    }
    for (int frame = 0; frame < 30; ++frame) {
        const long marked = loop.process(table());
        ASSERT_EQ(marked, 0) << frame;
    }
}

}  // namespace
}  // namespace touchstone
