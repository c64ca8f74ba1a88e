#include "pipeline/column_drift.hpp"

#include <gtest/gtest.h>
#include <random>

#include "pipeline/depth_map_conversion.hpp"
#include "tests/support/analytic_scene.hpp"
#include "tests/support/map_access.hpp"
#include "tests/support/structured_light_noise.hpp"

namespace touchstone {
namespace {

constexpr float step_per_m = 0.0029f;
const Intrinsics kinect{575.8f, 575.8f, 159.5f, 119.5f, 320, 240, {0, 0}};

test::DepthOfRay table() { return test::plane(Eigen::Vector3f(0.0f, 0.5f, std::sqrt(0.75f)), 0.9f); }

/// Closed loop: sense, convert with the shift of the frame before, measure what is left.
class Loop {
  public:
    Loop()
        : device_(DeviceConfig{}),
          conversion_(device_, {}, kinect),
          live_(device_, make_map_shape(kinect)),
          background_(device_, live_.shape),
          foreground_(device_, live_.shape),
          drift_(device_, {}, kinect) {
        background_.depth_m.write(test::padded<float>(live_.shape, test::render_depth_m(kinect, table())));
        sensor.column_shift_steps.assign(static_cast<std::size_t>(kinect.width_px), 0.0f);
    }

    /// Shift per column in disparity steps after some frames of this scene.
    std::vector<float> run(int frames, const test::DepthOfRay& scene) {
        const std::vector<float> depth_m = test::render_depth_m(kinect, scene);
        std::span<const float> shift;
        for (int frame = 0; frame < frames; ++frame) {
            const std::vector<std::uint16_t> depth_mm = test::sense(sensor, kinect, depth_m, random_);
            conversion_.convert({depth_mm, kinect}, live_);
            shift = drift_.update(live_, background_, foreground_);
            conversion_.set_column_shift(shift);
        }
        std::vector<float> steps;
        for (const float s : shift) steps.push_back(s / step_per_m);
        return steps;
    }
    void exclude(int first_x, int end_x) {
        const auto mask = foreground_.background_mask.map_update();
        for (int y = 0; y < kinect.height_px; ++y) {
            for (int x = first_x; x < end_x; ++x) mask[map_index(live_.shape, x, y)] = 255;
        }
    }

    test::StructuredLight sensor;

  private:
    Device device_;
    DepthMapConversion conversion_;
    LiveMaps live_;
    SurfacePrediction background_;
    Foreground foreground_;
    ColumnDrift drift_;
    std::mt19937 random_{2};
};

float largest(const std::vector<float>& values) {
    float result = 0.0f;
    for (const float v : values) result = std::max(result, std::abs(v));
    return result;
}

/// A patch of rows [first, end) and columns [100, 220), nearer than the table by so many steps.
test::DepthOfRay patch_above(float steps, int first_row, int end_row) {
    return [=](const Eigen::Vector3f& ray) {
        const float x = ray.x() * kinect.fx_px + kinect.cx_px, y = ray.y() * kinect.fy_px + kinect.cy_px;
        const bool on = x >= 100.0f && x < 220.0f && y >= static_cast<float>(first_row) &&
                        y < static_cast<float>(end_row);
        const float z = table()(ray);
        return on ? 1.0f / (1.0f / z + steps * step_per_m) : z;
    };
}

TEST(TypicalResidual, IsTheMeanAroundTheMedian) {
    ResidualBins bins;
    // Bins of half a step from -4 steps on: 60 samples about 1.1 steps, and 20 far away.
    bins.counts[10] = 60.0f, bins.sums_per_m[10] = 60.0f * 1.1f * step_per_m;
    bins.counts[2] = 20.0f, bins.sums_per_m[2] = -20.0f * 2.8f * step_per_m;
    EXPECT_NEAR(*typical_residual_per_m(bins, {}), 1.1f * step_per_m, 1e-7f);
    bins.counts[10] = 10.0f, bins.counts[2] = 0.0f;
    EXPECT_FALSE(typical_residual_per_m(bins, {}));
    bins = {};
    EXPECT_FALSE(typical_residual_per_m(bins, {}));
    bins.counts[0] = 100.0f;
    EXPECT_FALSE(typical_residual_per_m(bins, {})) << "most of it may lie outside the histogram";
}

/// Without drift the shift stays within a tenth of a step over 150 frames of noise.
TEST(ColumnDrift, StandsStillWithoutDrift) {
    Loop loop;
    EXPECT_LT(largest(loop.run(150, table())), 0.1f);
}

/// Bands of -2 to +2 steps with sharp borders: followed to 0.15 steps everywhere, also beside the borders,
/// and stable afterwards.
TEST(ColumnDrift, FollowsBandsWithSteps) {
    Loop loop;
    const auto band = [](std::size_t x) { return static_cast<float>(x / 64) - 2.0f; };
    for (std::size_t x = 0; x < 320; ++x) loop.sensor.column_shift_steps[x] = band(x);
    for (const int frames : {80, 10, 10, 50}) {
        const std::vector<float> shift = loop.run(frames, table());
        for (std::size_t x = 0; x < 320; ++x) ASSERT_NEAR(shift[x], -band(x), 0.15f) << x;
    }
}

/// After 12 frames, the time constant, about two thirds of a sudden drift are followed: neither at once nor
/// late.
TEST(ColumnDrift, FollowsSlowly) {
    Loop loop;
    std::ranges::fill(loop.sensor.column_shift_steps, 1.0f);
    const std::vector<float> shift = loop.run(12, table());
    for (const float s : shift) ASSERT_NEAR(s, -0.63f, 0.15f);
}

TEST(ColumnDrift, HoldsColumnsThatTheForegroundHides) {
    Loop loop;
    std::ranges::fill(loop.sensor.column_shift_steps, 1.5f);
    loop.exclude(100, 220);
    const std::vector<float> shift = loop.run(80, table());
    for (std::size_t x = 0; x < 320; ++x) {
        // The median over five columns reaches two columns into what is hidden.
        if (x >= 102 && x < 218) {
            ASSERT_EQ(shift[x], 0.0f) << x;
        } else if (x < 98 || x >= 222) {
            ASSERT_NEAR(shift[x], -1.5f, 0.2f) << x;
        }
    }
}

/// A sheet of 1, 2 or 4 steps (3, 6, 12 mm at 1 m) put down over 40 % of the rows: one step cannot be told
/// from noise and loses half of itself at most; thicker ones lose at most 0.3 steps.
TEST(ColumnDrift, DoesNotSwallowWhatWasPutDown) {
    for (const auto& [steps, lost_steps] : {std::pair{1.0f, 0.5f}, {2.0f, 0.3f}, {4.0f, 0.3f}}) {
        Loop loop;
        EXPECT_LT(largest(loop.run(150, patch_above(steps, 100, 196))), lost_steps) << steps;
    }
}

TEST(ColumnDrift, NeverGoesBeyondItsLimit) {
    Loop loop;
    std::ranges::fill(loop.sensor.column_shift_steps, 2.0f);
    (void)loop.run(60, table());
    std::ranges::fill(loop.sensor.column_shift_steps, 4.5f);
    EXPECT_LE(largest(loop.run(100, table())), 3.001f);
}

}  // namespace
}  // namespace touchstone
