#include <filesystem>
#include <gtest/gtest.h>
#include <iostream>
#include <numeric>
#include <optional>

#include "pipeline/background_model.hpp"
#include "pipeline/column_drift.hpp"
#include "pipeline/depth_map_conversion.hpp"
#include "pipeline/foreground_segmentation.hpp"
#include "platform/image/png_file.hpp"
#include "tests/support/map_access.hpp"

namespace touchstone {
namespace {

const std::filesystem::path data = std::filesystem::path(TOUCHSTONE_SHARED_DIR) / "data";

struct Score {
    int both = 0, either = 0, false_pixels = 0, background_pixels = 0;
};

/// Over the pixels with a label, a reading and a background; labels from 20 on are objects.
Score score_mask(const std::vector<std::uint8_t>& mask, const Image8& label, const Image16& live,
                 const Image16& background) {
    Score score;
    for (std::size_t i = 0; i < mask.size(); ++i) {
        if (label.pixels[i] == 0 || live.pixels[i] == 0 || background.pixels[i] == 0) continue;
        const bool object = label.pixels[i] >= 20, found = mask[i] != 0;
        score.both += object && found;
        score.either += object || found;
        score.false_pixels += !object && found;
        score.background_pixels += !object;
    }
    return score;
}

/// 16 labelled scenes on a real table. Plain subtraction with the best fixed threshold has an IoU of 0.976.
TEST(SegmentationRecordings, ObjectsOnALabelledTable) {
    const std::filesystem::path folder = data / "table-fixed-camera-a";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
    const Intrinsics k{525.0f, 525.0f, 319.5f, 239.5f, 640, 480, {0, 0}};
    const Device device(DeviceConfig{});
    DepthMapConversion conversion(device, {}, k);
    LiveMaps live(device, make_map_shape(k));
    SurfacePrediction model(device, live.shape);
    const Image16 background = read_png_16(folder / "background.depth.png");
    conversion.convert({background.pixels, k}, live);
    model.depth_m.copy_from(live.filtered_m);
    model.normals_c.copy_from(live.normals_c);
    double iou_sum = 0.0;
    const std::vector<std::string> scenes{"learn17", "learn18", "learn19", "learn20", "learn21", "learn22",
                                          "learn23", "learn24", "test16",  "test17",  "test18",  "test19",
                                          "test20",  "test21",  "test22",  "test23"};
    for (const std::string& scene : scenes) {
        const Image16 picture = read_png_16(folder / (scene + ".depth.png"));
        conversion.convert({picture.pixels, k}, live);
        ForegroundSegmentation segmentation(device, {}, k);
        const Foreground& foreground = segmentation.segment(live, model);
        const Score score = score_mask(test::cropped(live.shape, foreground.mask.read()),
                                       read_png_8(folder / (scene + ".label.png")), picture, background);
        const double iou = static_cast<double>(score.both) / score.either;
        const double false_share = static_cast<double>(score.false_pixels) / score.background_pixels;
        EXPECT_GT(iou, 0.97) << scene;
        EXPECT_LT(false_share, 0.002) << scene;
        iou_sum += iou;
    }
    std::cout << "mean IoU " << iou_sum / static_cast<double>(scenes.size()) << "\n";
    EXPECT_GT(iou_sum / static_cast<double>(scenes.size()), 0.98);
}

class Room {
  public:
    /// Marked share of the valid pixels.
    double process(int frame) {
        const Image16 picture = read_png_16(data / "kinect-room-person" / name(frame));
        const DepthView view{picture.pixels, k_};
        conversion_.convert(view, live_);
        if (!background_) background_.emplace(device_, config(), k_, *fit_volume(view, 4.5f));
        if (frame < 20) {
            background_->scan(live_);
            segmentation_.learn(live_, background_->prediction());
            return 0.0;
        }
        const Foreground& foreground = segmentation_.segment(live_, background_->prediction());
        segmentation_.mask_background(live_, background_->prediction());
        const std::vector<std::uint8_t> mask = foreground.mask.read();
        conversion_.set_column_shift(drift_.update(live_, background_->prediction(), foreground));
        background_->follow(live_, foreground.background_mask);
        const std::vector<float> depth_m = live_.depth_m.read();
        const auto valid = std::ranges::count_if(depth_m, [](float z) { return z > 0.0f; });
        return static_cast<double>(std::ranges::count(mask, 255)) / static_cast<double>(valid);
    }

  private:
    static std::string name(int frame) {
        const std::string number = std::to_string(frame);
        return "frame-" + std::string(6 - number.size(), '0') + number + ".depth.png";
    }
    static BackgroundConfig config() {
        BackgroundConfig config;
        config.volume.size_vox = 256;
        return config;
    }

    Intrinsics k_{575.8f, 575.8f, 319.5f, 239.5f, 640, 480, {0, 0}};
    Device device_{DeviceConfig{}};
    DepthMapConversion conversion_{device_, {}, k_};
    LiveMaps live_{device_, make_map_shape(k_)};
    ForegroundSegmentation segmentation_{device_, {}, k_};
    ColumnDrift drift_{device_, {}, k_};
    std::optional<BackgroundModel> background_;
};

/// A Kinect's room, empty (0-27), with a person near the camera, and empty again while the sensor's column
/// bands have drifted by up to 2.6 steps (330-345), with the masked background going on all the time.
TEST(SegmentationRecordings, APersonComesAndGoes) {
    if (!std::filesystem::exists(data / "kinect-room-person")) GTEST_SKIP() << "no recording here";
    Room room;
    double empty_before = 0.0, empty_after = 0.0, person = 1.0;
    for (int frame = 0; frame < 346; ++frame) {
        const double share = room.process(frame);
        if (frame >= 20 && frame < 28) empty_before = std::max(empty_before, share);
        if (frame >= 90 && frame < 220) person = std::min(person, share);
        if (frame >= 330) empty_after = std::max(empty_after, share);
    }
    std::cout << "largest share marked: before " << empty_before << ", after " << empty_after
              << "; smallest with the person close " << person << "\n";
    EXPECT_LT(empty_before, 0.001);
    EXPECT_LT(empty_after, 0.001);
    EXPECT_GT(person, 0.35);
}

}  // namespace
}  // namespace touchstone
