// The running table's projector, simulated: calibrated from the operator's panel, and looked at by itself.
#include "app/projector_desk.hpp"

#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/displays.hpp"
#include "app/perception.hpp"
#include "app/presentation.hpp"
#include "platform/display/headless_display.hpp"
#include "platform/openni2_drivers/simulator/projector.hpp"
#include "platform/openni2_drivers/simulator/simulator_config.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr PixelSize small{640, 400};  // the simulator stretches it: a quarter of the work

std::unique_ptr<Display> small_projector() {
    return std::make_unique<SimulatedProjector>(make_headless_display(small), projected_picture_name());
}

RunOptions table(const std::string& sensor, const std::filesystem::path& calibration) {
    RunOptions options;
    options.config.sensor_uri = sensor;
    options.config.projector.file = calibration.string();
    options.config.tuio.enabled = false;
    options.config.log_level = "error";
    options.config.interaction.background.volume.size_vox = 128;
    options.pace = Pace::step;
    return options;
}

/// Of the simulated projector, as a calibration without any error would write it.
void write_truth(const std::filesystem::path& file, std::uint64_t seed, PixelSize size = small) {
    const SimulatorConfig config;
    const sim::TableView view = sim::make_table_view(config.height_m, config.tilt_deg);
    const sim::Projector truth = sim::make_projector(view, seed);
    SavedProjector saved;
    saved.model.width_px = truth.width_px;
    saved.model.height_px = truth.height_px;
    saved.model.focal_px = truth.focal_px;
    saved.model.center_px = truth.center_px;
    saved.model.distortion = truth.distortion;
    saved.model.T_p_g.linear() = truth.rotation_p_s * view.rotation_s_c;
    saved.model.T_p_g.translation() = truth.rotation_p_s * (view.camera_s - truth.position_s);
    saved.model = stretched(saved.model, size.width_px, size.height_px);
    saved.method = "graycode";
    saved.written_s = 1'790'000'000;
    save_projector(file, saved);
}

/// `run` in lock step, with an operator.
class RunningTable {
  public:
    explicit RunningTable(const RunOptions& options)
        : perception_(options), presentation_(options, small_projector) {}

    /// Draws the frame unless the display stands still.
    TableFrame step() {
        TableFrame frame = perception_.step().value();
        if (!stands_still) {
            presentation_.draw(frame);
            presentation_.show();
        }
        TableWish wish = presentation_.wish();
        wish.operating.open = true;
        wish.operating.projector_calibrations = calibrations;
        perception_.take(std::move(wish));
        perception_.follow();
        return frame;
    }
    /// Until the panel says so; the last frame.
    TableFrame run_until_panel_says(const std::string& words, int most_frames = 420) {
        TableFrame frame;
        for (int i = 0; i < most_frames; ++i) {
            frame = step();
            thrown_frames += frame.thrown ? 1 : 0;
            if (frame.operating && frame.operating->projector.find(words) != std::string::npos) return step();
        }
        ADD_FAILURE() << "never said: " << words
                      << "; but: " << (frame.operating ? frame.operating->projector : "nothing");
        return frame;
    }
    TableFrame run_until_live() {
        for (int i = 0; i < 100; ++i)
            if (TableFrame frame = step(); frame.state == "live" && frame.operating) return frame;
        ADD_FAILURE() << "never live";
        return {};
    }

    bool stands_still = false;
    int calibrations = 0, thrown_frames = 0;

  private:
    Perception perception_;
    Presentation presentation_;
};

class ProjectorDeskRun : public testing::Test {
  protected:
    const TemporaryFolder folder_;
    const std::filesystem::path file_ = folder_ / "projector";
};

TEST_F(ProjectorDeskRun, TheOperatorCalibratesInTheRunningProgram) {
    RunningTable run(table("sim:flat?projector=1&hands=1&seed=12&empty=20", file_));
    const TableFrame before = run.run_until_live();
    EXPECT_TRUE(before.operating->can_calibrate_projector);
    EXPECT_FALSE(before.projector);
    EXPECT_THAT(before.operating->projector, HasSubstr("not calibrated"));
    run.calibrations = 1;
    const TableFrame after = run.run_until_panel_says("is calibrated");
    EXPECT_TRUE(after.projector) << "used at once";
    EXPECT_FALSE(after.thrown);
    EXPECT_EQ(load_projector(file_).method, "graycode");
    EXPECT_LT(load_projector(file_).rms_px, 1.5f);
    EXPECT_GT(load_projector(file_).written_s, 0);
    EXPECT_THAT(run.run_until_panel_says("falls right").note, IsEmpty());
}

TEST_F(ProjectorDeskRun, WhatCannotBeWrittenIsUsedAndSaid) {
    RunningTable run(table("sim:flat?projector=1&hands=0&seed=12&empty=20", "/proc/nowhere/projector"));
    run.run_until_live();
    run.calibrations = 1;
    const TableFrame after = run.run_until_panel_says("It is not kept");
    EXPECT_TRUE(after.projector) << "used until the table ends";
    EXPECT_THAT(after.operating->faults,
                testing::Contains(HasSubstr("disk: the projector's calibration is not kept")));
}

TEST_F(ProjectorDeskRun, WithoutColoursItAsksForTouches) {
    write_truth(file_, 12);
    RunningTable run(table("sim:flat?projector=1&hands=1&seed=12&guided=1&color=0", file_));
    const TableFrame live = run.run_until_live();
    EXPECT_THAT(run.run_until_panel_says("cannot be checked").operating->projector, HasSubstr("2026-09-2"));
    const auto old = live.projector;
    run.calibrations = 1;
    int touched = 0, crosses = 0;
    std::optional<Eigen::Vector2f> last;
    for (int i = 0; i < 600 && crosses < 4; ++i) {
        const TableFrame frame = run.step();
        touched += static_cast<int>(frame.touches.size());
        if (frame.thrown && frame.thrown->cross_px && frame.thrown->cross_px != last) {
            last = frame.thrown->cross_px;
            ++crosses;
        }
    }
    EXPECT_EQ(crosses, 4) << "three were touched";
    EXPECT_EQ(touched, 0) << "they touch nothing else";
}

TEST_F(ProjectorDeskRun, WhatFailsLeavesTheOldCalibrationInUse) {
    write_truth(file_, 12);
    RunOptions options = table("sim:flat?projector=1&hands=0&seed=12", file_);
    options.config.projector.check_mm = 0.0f;
    RunningTable run(options);
    run.run_until_live();
    const auto old = run.step().projector;
    ASSERT_TRUE(old);
    run.calibrations = 1;
    run.step();
    run.stands_still = true;
    const TableFrame after = run.run_until_panel_says("not calibrated anew");
    EXPECT_THAT(after.operating->projector, HasSubstr("display"));
    EXPECT_EQ(after.projector, old);
    EXPECT_FALSE(after.thrown);
    EXPECT_EQ(load_projector(file_).written_s, 1'790'000'000) << "the file is as it was";
}

TEST_F(ProjectorDeskRun, ARightFilePassesTheLookAtTheStartQuickly) {
    write_truth(file_, 12);
    RunningTable run(table("sim:curved?projector=1&hands=0&seed=12", file_));
    const TableFrame frame = run.run_until_panel_says("falls right");
    EXPECT_THAT(frame.note, IsEmpty());
    EXPECT_FALSE(frame.thrown);
    EXPECT_GT(run.thrown_frames, 0);
    EXPECT_LT(run.thrown_frames, 60) << "under two seconds of frames";
    for (int i = 0; i < 60; ++i) EXPECT_FALSE(run.step().thrown) << "once is enough";
}

TEST_F(ProjectorDeskRun, AProjectorThatWasMovedIsFoundOut) {
    write_truth(file_, 12);
    RunningTable run(table("sim:flat?projector=1&hands=0&seed=12&projector_moved_mm=20", file_));
    const std::string words = run.run_until_panel_says("off: calibrate it again").operating->projector;
    const double off_mm = std::stod(words.substr(words.find("falls ") + 6));
    EXPECT_NEAR(off_mm, 20.0, 2.0) << words;
    EXPECT_THAT(run.step().note, HasSubstr("calibrate it again"));
    EXPECT_THAT(run.step().note, HasSubstr("corner")) << "how to";
}

TEST_F(ProjectorDeskRun, AFileOfAnotherProjectorIsFoundOut) {
    write_truth(file_, 13);
    RunningTable run(table("sim:flat?projector=1&hands=0&seed=12", file_));
    EXPECT_THAT(run.run_until_panel_says("calibrate it again").note, HasSubstr("calibrate it again"));
}

TEST_F(ProjectorDeskRun, AFileOfAnotherResolutionIsSaid) {
    write_truth(file_, 12, {1280, 800});
    RunOptions options = table("sim:flat?projector=1&hands=0&seed=12", file_);
    options.config.projector.check_mm = 0.0f;
    RunningTable run(options);
    run.run_until_live();
    EXPECT_THAT(run.step().note, HasSubstr("1280x800, and shows 640x400"));
}

/// A camera that was knocked finds itself in the scan again; where it hangs alone the light stays where it
/// was, and that is looked at.
TEST_F(ProjectorDeskRun, AfterAKnockTheLightIsLookedAtOnceMore) {
    write_truth(file_, 12);
    RunOptions options =
        table("sim:mixed?projector=1&hands=0&seed=12&knock_s=7&knock_deg=2&knock_mm=15", file_);
    options.config.interaction.background.volume = InteractionConfig{}.background.volume;
    RunningTable run(options);
    run.run_until_panel_says("falls right");
    const int thrown = std::exchange(run.thrown_frames, 0);
    ASSERT_GT(thrown, 0);
    TableFrame frame;
    for (int i = 0; i < 300 && frame.state != "realigning"; ++i) {
        frame = run.step();
        ASSERT_FALSE(frame.thrown) << "before the knock once was enough";
    }
    ASSERT_EQ(frame.state, "realigning");
    for (int i = 0; i < 100 && frame.state != "live"; ++i) frame = run.step();
    EXPECT_THAT(frame.note, HasSubstr("camera was moved")) << "until it is known";
    for (int i = 0; i < 300 && !frame.note.empty(); ++i) {
        frame = run.step();
        run.thrown_frames += frame.thrown ? 1 : 0;
    }
    EXPECT_THAT(frame.note, IsEmpty());
    EXPECT_THAT(run.step().operating->projector, HasSubstr("falls right"));
    EXPECT_GT(run.thrown_frames, 0);
    EXPECT_LT(run.thrown_frames, 60);
}

/// Hands are over the table all the time: scenes are not disturbed, nothing is measured.
TEST_F(ProjectorDeskRun, ALookWaitsUntilNobodyIsThere) {
    write_truth(file_, 12);
    RunningTable run(table("sim:flat?projector=1&hands=2&seed=12&empty=1&projector_moved_mm=20", file_));
    run.run_until_live();
    int thrown = 0, touched = 0;
    for (int i = 0; i < 120; ++i) {
        const TableFrame frame = run.step();
        thrown += frame.thrown ? 1 : 0;
        touched += static_cast<int>(frame.touches.size());
    }
    EXPECT_EQ(thrown, 0);
    EXPECT_GT(touched, 0);
}

}  // namespace
}  // namespace touchstone
