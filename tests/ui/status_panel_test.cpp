#include "ui/status_panel.hpp"

#include <gtest/gtest.h>

namespace touchstone {
namespace {

TableFrame frame_in(const std::string& state) {
    TableFrame frame;
    frame.state = state;
    frame.frame_rate_hz = 29.7f;
    frame.frame_ms = 7.94f;
    frame.note = "check the lamp";
    return frame;
}

TEST(StatusWords, LiveTellsRateTimeTouchesAndNote) {
    const StatusWords words = status_words(frame_in("live"), "Touch it", {3, 8});
    EXPECT_EQ(words.state.word, "Live");
    EXPECT_EQ(words.invitation, "Touch it");
    EXPECT_EQ(words.note, "check the lamp");
    ASSERT_EQ(words.figures.size(), 3U);
    EXPECT_EQ(words.figures[0].value, "30");
    EXPECT_EQ(words.figures[1].value, "7.9");
    EXPECT_EQ(words.figures[2].value, "2");
    EXPECT_EQ(words.figures[2].unit, "touches");
}

TEST(StatusWords, OneTouchIsSingular) {
    EXPECT_EQ(status_words(frame_in("live"), "", {3}).figures.back().unit, "touch");
}

TEST(StatusWords, WhileWaitingTheCardSaysTheNoteAndNobodyIsInvited) {
    const StatusWords words = status_words(frame_in("sensor_lost"), "Touch it", {});
    EXPECT_EQ(words.state.word, "No camera");
    EXPECT_TRUE(words.figures.empty());
    EXPECT_TRUE(words.invitation.empty());
    EXPECT_TRUE(words.note.empty());
}

TEST(StatusWords, UnknownStateIsShownByItsName) { EXPECT_EQ(state_look("dancing").word, "dancing"); }

}  // namespace
}  // namespace touchstone
