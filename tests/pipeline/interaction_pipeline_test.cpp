#include "pipeline/interaction_pipeline.hpp"

#include <gtest/gtest.h>

#include "platform/openni2_drivers/simulator/simulator_source.hpp"

namespace touchstone {
namespace {

class InteractionPipelineTest : public testing::Test {
  protected:
    InteractionFrame next(InteractionPipeline& pipeline, FrameSource& source) {
        EXPECT_TRUE(source.next(picture));
        return pipeline.process({picture.depth_mm, source.info().intrinsics}, picture.timestamp_us);
    }

    Device device{DeviceConfig{}};
    InteractionConfig config;
    SourceFrame picture;
};

TEST_F(InteractionPipelineTest, StillSceneIsLiveAfterTheScanAndStaysEmpty) {
    const auto source = open_simulator("flat?seed=2&hands=0");
    InteractionPipeline pipeline(device, config, source->info().intrinsics);
    for (int frame = 0; frame < config.scan_frames; ++frame) {
        const InteractionFrame result = next(pipeline, *source);
        EXPECT_EQ(result.state, InteractionState::scanning);
        EXPECT_EQ(result.scan_frames_done, frame + 1);
    }
    EXPECT_TRUE(pipeline.area().has_value());
    for (int frame = 0; frame < 10; ++frame) {
        const InteractionFrame result = next(pipeline, *source);
        EXPECT_EQ(result.state, InteractionState::live);
        EXPECT_TRUE(result.touches.empty() && result.hovers.empty());
        const std::vector<std::uint8_t> map = pipeline.foreground_map();
        EXPECT_EQ(map.size(), 640u * 480u);
        EXPECT_EQ(std::ranges::count(map, 255), 0);
    }
}

TEST_F(InteractionPipelineTest, HandsBecomeForegroundHoversAndTouches) {
    config.scan_frames = 15;
    const auto source = open_simulator("flat?seed=2&hands=1&empty=0.6");
    InteractionPipeline pipeline(device, config, source->info().intrinsics);
    std::size_t hovers = 0, downs = 0;
    long most_foreground = 0;
    for (int frame = 0; frame < 300 && downs == 0; ++frame) {
        const InteractionFrame result = next(pipeline, *source);
        hovers += result.hovers.size();
        downs += static_cast<std::size_t>(
            std::ranges::count(result.touches, TouchPhase::down, &TouchEvent::phase));
        most_foreground =
            std::max(most_foreground, static_cast<long>(std::ranges::count(pipeline.foreground_map(), 255)));
    }
    EXPECT_GT(hovers, 5u);
    EXPECT_GT(downs, 0u);
    EXPECT_GT(most_foreground, 5000);
    // The camera stumbles, and then it is gone: the finger that was down is lifted once.
    pipeline.release_touches();
    pipeline.release_touches();
    const auto ups = [&] {
        return std::ranges::count(next(pipeline, *source).touches, TouchPhase::up, &TouchEvent::phase);
    };
    EXPECT_EQ(ups(), static_cast<long>(downs));
    EXPECT_EQ(ups(), 0);
    const ShadedView view = pipeline.view();
    EXPECT_EQ(view.width_px, 640);
}

TEST_F(InteractionPipelineTest, WaitsWhileTheCameraSeesNothing) {
    const auto source = open_simulator("flat?seed=2&hands=0");
    const Intrinsics k = source->info().intrinsics;
    InteractionPipeline pipeline(device, config, k);
    const std::vector<std::uint16_t> nothing(static_cast<std::size_t>(k.width_px * k.height_px), 0);
    const InteractionFrame result = pipeline.process({nothing, k}, 0);
    EXPECT_EQ(result.state, InteractionState::starting);
    EXPECT_FALSE(result.note.empty());
    EXPECT_TRUE(pipeline.view().rgba.empty());
    EXPECT_EQ(std::ranges::count(pipeline.foreground_map(), 0), 640 * 480);
    EXPECT_EQ(next(pipeline, *source).state, InteractionState::scanning)
        << "it starts once there is something";
}

TEST_F(InteractionPipelineTest, StagesAreTimedByTheirNames) {
    const auto source = open_simulator("flat?seed=2&hands=0");
    config.scan_frames = 1;
    InteractionPipeline pipeline(device, config, source->info().intrinsics);
    for (int frame = 0; frame < 3; ++frame) next(pipeline, *source);
    for (const char* stage :
         {"frame", "depth map conversion", "foreground segmentation", "touch detection"}) {
        EXPECT_GT(pipeline.stage_times().summary(stage).frames, 0u) << stage;
    }
    EXPECT_EQ(pipeline.stage_times().summary("normal maps").frames, 3u)
        << "scanning or live, each frame has its own";
}

}  // namespace
}  // namespace touchstone
