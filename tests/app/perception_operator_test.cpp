// What the operator asks of the perception loop.
#include <gtest/gtest.h>

#include "app/perception.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

RunOptions small_table() {
    RunOptions options;
    options.config.sensor_uri = "sim:flat?hands=0&seed=3";
    options.config.tuio.enabled = false;
    options.config.interaction.background.volume.size_vox = 64;
    options.config.interaction.scan_frames = 4;
    options.pace = Pace::step;
    return options;
}

TableFrame step_until(Perception& perception, const std::string& state) {
    for (int i = 0; i < 40; ++i)
        if (const std::optional<TableFrame> frame = perception.step(); frame && frame->state == state)
            return *frame;
    ADD_FAILURE() << "never " << state;
    return {};
}

TableWish asking(bool open, int rescans, int recalibrations) {
    TableWish wish;
    wish.operating = {open, rescans, recalibrations, 0};
    return wish;
}

TEST(PerceptionOperator, IsToldWhatHappensOnlyWhileHeLooks) {
    Perception perception(small_table());
    EXPECT_FALSE(step_until(perception, "live").operating);
    perception.take(asking(true, 0, 0));
    const auto view = perception.step()->operating;
    ASSERT_TRUE(view);
    EXPECT_EQ(view->depth.size, (PixelSize{160, 120}));
    EXPECT_EQ(view->mask.gray.size(), 160U * 120U);
    EXPECT_FALSE(view->stages.empty());
    EXPECT_FALSE(view->can_record) << "no folder is named";
    EXPECT_NE(view->recording, "");
    perception.take(asking(false, 0, 0));
    EXPECT_FALSE(perception.step()->operating);
}

TEST(PerceptionOperator, ScansAnewAlsoWhereAScanIsSaved) {
    const TemporaryFolder folder;
    RunOptions options = small_table();
    options.config.scan_file = (folder / "table.scan").string();
    Perception perception(options);
    step_until(perception, "live");
    perception.follow();
    ASSERT_TRUE(std::filesystem::exists(folder / "table.scan"));
    perception.take(asking(true, 1, 0));
    EXPECT_EQ(perception.step()->state, "scanning");
    step_until(perception, "live");
    perception.take(asking(true, 1, 0));
    EXPECT_EQ(perception.step()->state, "live") << "once is once";
}

/// The disk may be full for hours: once is enough.
TEST(PerceptionOperator, IsToldOnceWhatIsNotOnTheDisk) {
    RunOptions options = small_table();
    options.config.scan_file = "/nowhere/table.scan";
    Perception perception(options);
    step_until(perception, "live");
    TableWish wish = asking(true, 0, 0);
    wish.operating.unsaved = "no room";
    perception.take(wish);
    perception.take(wish);
    for (int i = 0; i < 5; ++i) perception.step();
    const auto view = perception.step()->operating;
    ASSERT_TRUE(view);
    ASSERT_EQ(view->faults.size(), 2u);
    EXPECT_NE(view->faults[1].find("disk: the painting is not kept: no room"), std::string::npos);
    EXPECT_NE(view->faults[0].find("disk: the scan is not kept: cannot write /nowhere/table.scan"),
              std::string::npos);
    perception.take(asking(true, 0, 0));
    perception.take(wish);
    EXPECT_EQ(perception.step()->operating->faults.size(), 3u) << "it went well in between";
}

TEST(PerceptionOperator, AsksForTheCrossesAgain) {
    Perception perception(small_table());
    EXPECT_FALSE(step_until(perception, "live").cross);
    perception.take(asking(false, 0, 1));
    EXPECT_TRUE(perception.step()->cross);
}

}  // namespace
}  // namespace touchstone
