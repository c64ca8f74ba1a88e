#include "tests/accuracy/close_pairs.hpp"

#include <gtest/gtest.h>

namespace touchstone {
namespace {

TrueTip tip(int finger, double x_mm, double gap_mm = 0.0) {
    return {.hand = 0, .finger = finger, .gap_mm = gap_mm, .camera_mm = {x_mm, 0.0, 800.0}};
}

LoggedTouch touch(int id, double x_mm) { return {.id = id, .camera_mm = {x_mm, 0.0, 800.0}}; }

/// Both fingers down for two frames, so far apart, and in the air for eight.
TouchTruth pair_of(double apart_mm) {
    TouchTruth truth;
    for (int frame = 0; frame < 2; ++frame) truth.tips.push_back({tip(0, 0.0), tip(1, apart_mm)});
    for (int frame = 0; frame < 8; ++frame) truth.tips.push_back({tip(0, 0.0, 9.0), tip(1, apart_mm, 9.0)});
    return truth;
}

TEST(ClosePairs, AreThirtyToFortyFiveMillimetresApart) {
    for (const double apart_mm : {29.0, 30.0, 45.0, 46.0})
        EXPECT_EQ(score_close_pairs(pair_of(apart_mm), {}).contacts, apart_mm == 30.0 || apart_mm == 45.0);
}

TEST(ClosePairs, AreFoundWhenEachFingerHasItsTouch) {
    const TouchTruth truth = pair_of(35.0);
    EXPECT_EQ(score_close_pairs(truth, {{1, {touch(1, 2.0), touch(2, 33.0)}}}).found, 1);
    EXPECT_EQ(score_close_pairs(truth, {{1, {touch(1, 17.0)}}}).found, 0) << "one between the two";
    EXPECT_EQ(score_close_pairs(truth, {{0, {touch(1, 2.0)}}, {1, {touch(2, 33.0)}}}).found, 0)
        << "never both in one frame";
    EXPECT_EQ(score_close_pairs(truth, {{4, {touch(1, 2.0), touch(2, 33.0)}}}).found, 1);
    EXPECT_EQ(score_close_pairs(truth, {{5, {touch(1, 2.0), touch(2, 33.0)}}}).found, 0)
        << "four frames late";
}

TEST(ClosePairs, OneThatLastsToTheEndCounts) {
    TouchTruth truth = pair_of(35.0);
    truth.tips.resize(2);
    const Found pairs = score_close_pairs(truth, {{1, {touch(1, 2.0), touch(2, 33.0)}}});
    EXPECT_EQ(pairs.contacts, 1);
    EXPECT_EQ(pairs.found, 1);
}

}  // namespace
}  // namespace touchstone
