#include "pipeline/self_test.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "pipeline/background_model.hpp"
#include "pipeline/column_drift.hpp"
#include "pipeline/depth_map_conversion.hpp"
#include "pipeline/foreground_segmentation.hpp"
#include "pipeline/rendering.hpp"
#include "pipeline/touch_map.hpp"

namespace touchstone {

namespace {

constexpr int width_px = 64, height_px = 48;
constexpr std::size_t pixel_count = std::size_t{width_px} * std::size_t{height_px};
constexpr float wall_m = 1.0f, square_m = 0.985f;
constexpr int square_first_px = 20, square_last_px = 31;

const Intrinsics camera{64.0f, 64.0f, 31.5f, 23.5f, width_px, height_px, {0, 0}};

/// A wall at 1 m, facing the camera; with the square, 12 x 12 pixels of it stand 15 mm out.
std::vector<std::uint16_t> wall_mm(bool with_square) {
    std::vector<std::uint16_t> depth_mm(pixel_count, static_cast<std::uint16_t>(1000.0f * wall_m));
    if (!with_square) return depth_mm;
    for (int y = square_first_px; y <= square_last_px; ++y) {
        for (int x = square_first_px; x <= square_last_px; ++x) {
            depth_mm[static_cast<std::size_t>(y * width_px + x)] =
                static_cast<std::uint16_t>(1000.0f * square_m);
        }
    }
    return depth_mm;
}

class SelfTest {
  public:
    explicit SelfTest(const Device& device)
        : device_(device),
          shape_(make_map_shape(camera)),
          conversion_(device, {}, camera),
          live_(device, shape_) {}

    void run() {
        conversion_.convert({wall_mm(false), camera}, live_);
        check_conversion();
        BackgroundConfig config;
        config.volume.size_vox = 64;
        VolumePlacement placement{0.64f, RigidTransform::Identity()};
        placement.T_g_c.translation() = Eigen::Vector3f(0.32f, 0.32f, 0.32f - wall_m);
        BackgroundModel background(device_, config, camera, placement);
        for (int frame = 0; frame < 3; ++frame) background.scan(live_);
        expect_near("sample_weights, listing_2_tsdf_integration, listing_3_raycast",
                    at(background.prediction().depth_m, center()), wall_m, 0.001f);
        ForegroundSegmentation segmentation(device_, {}, camera);
        segmentation.learn(live_, background.prediction());
        conversion_.convert({wall_mm(true), camera}, live_);
        check_foreground(segmentation, background.prediction());
        check_drift(segmentation, background.prediction());
    }

  private:
    std::size_t center() const { return map_index(shape_, width_px / 2, height_px / 2); }
    std::size_t in_square() const { return map_index(shape_, square_first_px + 5, square_first_px + 5); }

    template <class T>
    float at(const Buffer<T>& map, std::size_t index) const {
        return static_cast<float>(map.map_read()[index]);
    }

    void expect_near(const std::string& stage, float got, float expected, float tolerance) const {
        if (std::abs(got - expected) <= tolerance) return;
        throw Error(ExitStatus::unavailable, "self-test: " + device_.name() + " computes " + stage +
                                                 " wrongly (" + std::to_string(got) + " instead of " +
                                                 std::to_string(expected) +
                                                 "); choose another device with compute.device");
    }

    void check_conversion() const {
        expect_near("depth_map_conversion:convert_depth", at(live_.depth_m, center()), wall_m, 1e-5f);
        expect_near("depth_map_conversion:bilateral_filter", at(live_.filtered_m, center()), wall_m, 1e-5f);
        expect_near("depth_map_conversion:normal_map", at(live_.normals_c, 2 * map_pixels(shape_) + center()),
                    -1.0f, 1e-4f);
    }

    void check_foreground(ForegroundSegmentation& segmentation, const SurfacePrediction& background) {
        const Foreground& foreground = segmentation.segment(live_, background);
        expect_near("connected_components", static_cast<float>(foreground.components.size()), 1.0f, 0.0f);
        expect_near("listing_1_data_association", at(foreground.mask, in_square()), 255.0f, 0.0f);
        expect_near("foreground_segmentation", at(foreground.mask, center() + 8), 0.0f, 0.0f);
        TouchMapping mapping(device_, {}, camera);
        TouchMap touch(device_, shape_);
        const PixelRegion all{0, 0, width_px, height_px};
        mapping.update(live_.depth_m, foreground.mask, background, std::span(&all, 1), touch);
        expect_near("listing_4_touch_map", at(touch.height_m, in_square()), wall_m - square_m, 0.001f);
        expect_near("listing_4_touch_map", at(touch.touch, in_square()), 255.0f, 0.0f);
        const ShadedView view =
            Rendering(device_, {}, camera).render(background, {live_.normals_c, foreground.mask});
        const auto alpha =
            static_cast<std::size_t>(4 * ((square_first_px + 5) * width_px + square_first_px + 5) + 3);
        expect_near("shading", static_cast<float>(view.rgba[alpha]), 0.0f, 0.0f);
    }

    /// The whole wall seems 3 mm farther: each column is to be drawn back by a share of that in 1/z.
    void check_drift(ForegroundSegmentation& segmentation, const SurfacePrediction& background) {
        const std::vector<std::uint16_t> drifted_mm(pixel_count, 1003);
        conversion_.convert({drifted_mm, camera}, live_);
        ColumnDriftConfig config;
        config.row_step = 1;
        ColumnDrift drift(device_, config, camera);
        const Foreground& foreground = segmentation.segment(live_, background);
        segmentation.mask_background(live_, background);
        const float column_shift = drift.update(live_, background, foreground)[width_px * 3 / 4 - 1];
        const float expected_per_m = config.gain * (1.0f / wall_m - 1.0f / 1.003f);
        expect_near("column_drift", column_shift / expected_per_m, 1.0f, 0.2f);
    }

    const Device& device_;
    MapShape shape_;
    DepthMapConversion conversion_;
    LiveMaps live_;
};

}  // namespace

void run_self_test(const Device& device) { SelfTest(device).run(); }

}  // namespace touchstone
