// The second volume inside the whole pipeline.
#include <gtest/gtest.h>

#include "pipeline/interaction_pipeline.hpp"
#include "platform/openni2_drivers/simulator/simulator_source.hpp"
#include "platform/system/error.hpp"

namespace touchstone {
namespace {

struct Outcome {
    std::vector<int> background_voxels;
    std::vector<InteractionFrame> frames;
    std::size_t largest_surface_px = 0;
    std::size_t outside_mask_px = 0;
    bool has_view = false;
};

Outcome run(const Device& device, bool reconstruct) {
    InteractionConfig config;
    config.scan_frames = 10;
    config.background.volume.size_vox = 256;
    config.foreground.reconstruct = reconstruct ? "on" : "off";
    const auto source = open_simulator("flat?seed=2&hands=1&empty=0.4");
    InteractionPipeline pipeline(device, config, source->info().intrinsics);
    Outcome outcome;
    SourceFrame picture;
    for (int frame = 0; frame < 60; ++frame) {
        EXPECT_TRUE(source->next(picture));
        outcome.frames.push_back(
            pipeline.process({picture.depth_mm, source->info().intrinsics}, picture.timestamp_us));
        if (pipeline.foreground_model() == nullptr) continue;
        const auto of_model = pipeline.foreground_model()->source().map_read();
        const std::vector<std::uint8_t> mask = pipeline.foreground_map();
        std::size_t surface_px = 0;
        for (std::size_t i = 0; i < mask.size(); ++i) {
            surface_px += of_model[i] != FOREGROUND_NONE;
            if (mask[i] != 0 && of_model[i] == FOREGROUND_NONE) ++outcome.outside_mask_px;
        }
        outcome.largest_surface_px = std::max(outcome.largest_surface_px, surface_px);
    }
    outcome.background_voxels = pipeline.background()->volume().pool().read();
    outcome.has_view = !pipeline.view().rgba.empty();
    return outcome;
}

TEST(ForegroundInThePipeline, TheBackgroundIsTheSameToTheBitWithAndWithout) {
    const Device device(DeviceConfig{});
    const Outcome with = run(device, true), without = run(device, false);
    EXPECT_EQ(with.background_voxels, without.background_voxels);
    EXPECT_GT(with.largest_surface_px, 5000u) << "the hand has come";
    EXPECT_EQ(with.outside_mask_px, 0u) << "all of the mask has a surface";
    EXPECT_TRUE(with.has_view && without.has_view);
    for (std::size_t i = 0; i < with.frames.size(); ++i) {
        EXPECT_EQ(with.frames[i].touches.size(), without.frames[i].touches.size());
        EXPECT_EQ(with.frames[i].hovers.size(), without.frames[i].hovers.size());
    }
}

TEST(ForegroundInThePipeline, IsOnByWordAndByDevice) {
    const Device device(DeviceConfig{});
    ForegroundModelConfig config;
    config.reconstruct = "on";
    EXPECT_TRUE(reconstructs_foreground(config, device));
    config.reconstruct = "off";
    EXPECT_FALSE(reconstructs_foreground(config, device));
    config.reconstruct = "auto";
    EXPECT_EQ(reconstructs_foreground(config, device), !device.is_cpu());
    config.reconstruct = "sometimes";
    EXPECT_THROW(reconstructs_foreground(config, device), Error);
}

}  // namespace
}  // namespace touchstone
