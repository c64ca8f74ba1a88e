#include "tests/accuracy/touch_score.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace touchstone {
namespace {

TrueTip tip(double gap_mm, double x_mm = 0.0, int finger = 0) {
    return {.hand = 0, .finger = finger, .gap_mm = gap_mm, .camera_mm = {x_mm, 0.0, 800.0}};
}

LoggedTouch touch(int id, double x_mm = 0.0) { return {.id = id, .camera_mm = {x_mm, 0.0, 800.0}}; }

/// One finger at x = 0 with the given gap in each frame.
TouchTruth one_finger(const std::vector<double>& gaps_mm) {
    TouchTruth truth;
    for (const double gap_mm : gaps_mm) truth.tips.push_back({tip(gap_mm)});
    return truth;
}

TEST(TouchScore, CountsContactsByTheirLength) {
    const auto truth =
        one_finger({50, 0, 50, 50, 50, 50, 50, 50, 0, 0, 50, 50, 50, 50, 50, 50, 0, 1, 0.5, 1.1});
    const TouchScore score = score_touches(truth, {{1, {touch(1)}}, {17, {touch(2)}}});
    EXPECT_EQ(score.all.contacts, 3);
    EXPECT_EQ(score.all.found, 2);
    EXPECT_EQ(score.of_one_frame.found, 1);
    EXPECT_EQ(score.of_two_frames.contacts, 1);
    EXPECT_EQ(score.of_two_frames.found, 0);
    EXPECT_EQ(score.of_three_and_more.found, 1);
    EXPECT_EQ(score.of_two_and_more.contacts, 2);
    EXPECT_EQ(score.of_two_and_more.found, 1);
}

TEST(TouchScore, ATouchFromTwoFramesBeforeToThreeAfterFindsTheContact) {
    const auto truth = one_finger({5, 5, 5, 0, 5, 5, 5, 5, 5});
    const auto found_at = [&](int frame) { return score_touches(truth, {{frame, {touch(1)}}}).all.found; };
    EXPECT_EQ(found_at(0), 0);
    EXPECT_EQ(found_at(1), 1);
    EXPECT_EQ(found_at(6), 1);
    EXPECT_EQ(found_at(7), 0);
    EXPECT_EQ(score_touches(truth, {{1, {touch(1)}}}).late_frames, (std::vector<double>{-2.0}));
    EXPECT_EQ(score_touches(truth, {{5, {touch(1)}}}).late_frames, (std::vector<double>{2.0}));
}

TEST(TouchScore, ATouchWithoutAFingerNearItIsSpurious) {
    const auto truth = one_finger({0, 0, 50, 50});
    const TouchScore far = score_touches(truth, {{0, {touch(1), touch(2, 26.0)}}});
    EXPECT_EQ(far.spurious_ids, 1);
    EXPECT_EQ(far.false_frames, 1);
    const TouchScore high = score_touches(truth, {{2, {touch(1)}}});
    EXPECT_EQ(high.spurious_ids, 1) << "the finger is 50 mm up";
    const TouchScore once_right = score_touches(truth, {{1, {touch(1)}}, {2, {touch(1)}}});
    EXPECT_EQ(once_right.spurious_ids, 0) << "an id that was right once";
    EXPECT_EQ(once_right.false_frames, 1);
}

TEST(TouchScore, NamesWhatIsMissedAndWhatIsSpurious) {
    const TouchScore score =
        score_touches(one_finger({9, 0, 0, 9, 9, 9, 9, 9}), {{6, {touch(5, 70.0)}}, {7, {touch(5, 71.0)}}});
    ASSERT_EQ(score.missed.size(), 1U);
    EXPECT_EQ(score.missed.front().first_frame, 1);
    EXPECT_EQ(score.missed.front().last_frame, 2);
    ASSERT_EQ(score.spurious.size(), 1U);
    EXPECT_EQ(score.spurious.front().id, 5);
    EXPECT_EQ(score.spurious.front().first_frame, 6);
    EXPECT_EQ(score.spurious.front().camera_mm[0], 70.0);
}

TEST(TouchScore, PositionIsScoredWithinContacts) {
    const TouchScore score = score_touches(
        one_finger({0, 0, 5}), {{0, {touch(1, 3.0)}}, {1, {touch(1, -4.0)}}, {2, {touch(1, 20.0)}}});
    EXPECT_EQ(score.position_mm, (std::vector<double>{3.0, 4.0}));
}

TEST(TouchScore, CountsIdSwitchesWithinAContact) {
    const TouchScore score =
        score_touches(one_finger({0, 0, 0, 0}), {{0, {touch(1)}}, {1, {touch(2)}}, {2, {touch(2)}}});
    EXPECT_EQ(score.id_switches, 1);
    EXPECT_EQ(score.true_frames, 3);
    EXPECT_EQ(score.missed_frames, 1);
}

TEST(TouchScore, ADragIsAContactThatMovesByTwentyMillimetres) {
    TouchTruth truth;
    TouchLog log;
    for (int frame = 0; frame < 3; ++frame) {
        truth.tips.push_back({tip(0.0, 10.0 * frame, 0), tip(0.0, 200.0 + 9.0 * frame, 1)});
        log[frame] = {touch(frame, 10.0 * frame), touch(7 + frame, 200.0 + 9.0 * frame)};
    }
    const TouchScore score = score_touches(truth, log);
    EXPECT_EQ(score.drags, 1) << "20 mm, not 18";
    EXPECT_EQ(score.drag_id_switches, 2);
    EXPECT_EQ(score.id_switches, 4);
}

TEST(TouchScore, MatchesTwoFingersOneToOne) {
    TouchTruth truth;
    truth.tips.push_back({tip(0.0, 0.0, 0), tip(0.0, 20.0, 1)});
    const TouchScore one = score_touches(truth, {{0, {touch(1, 8.0)}}});
    EXPECT_EQ(one.all.found, 1);
    EXPECT_EQ(one.second_fingers.contacts, 1);
    EXPECT_EQ(one.second_fingers.found, 0) << "the one touch is nearer to the other finger";
    const TouchScore both = score_touches(truth, {{0, {touch(1, 8.0), touch(2, 2.0)}}});
    EXPECT_EQ(both.all.found, 2);
    EXPECT_EQ(both.position_mm, (std::vector<double>{2.0, 12.0}));
}

TEST(TouchScore, HoverIsToldFromTheGapAboveWhichNineteenOfTwentyAreRight) {
    TouchTruth truth;
    TouchLog log;
    for (int frame = 0; frame < 400; ++frame) {
        const double gap_mm = 5.5 + frame / 20;  // 20 frames in each millimetre, to 24.5
        truth.tips.push_back({tip(gap_mm)});
        // One of 20 is mistaken everywhere, two of 20 below 9 mm.
        if (frame % 20 == 0 || (gap_mm < 9.0 && frame % 20 == 1)) log[frame] = {touch(frame)};
    }
    const HoverScore hover = score_touches(truth, log).hover;
    EXPECT_EQ(hover.tips, 400);
    EXPECT_EQ(hover.mistaken, 24);
    EXPECT_DOUBLE_EQ(hover.told_from_mm.value(), 9.0);
    EXPECT_DOUBLE_EQ(hover.smallest_mistaken_mm.value(), 5.5);
    EXPECT_DOUBLE_EQ(hover.largest_mistaken_mm.value(), 24.5);
}

TEST(TouchScore, ApproachAndRetreatOfAContactAreNoHover) {
    const auto truth = one_finger({40, 8, 4, 0, 4, 8, 12, 40});
    EXPECT_EQ(score_touches(truth, {}).hover.tips, 2)
        << "only frames 0 and 7 are outside two before to three after";
}

TEST(TouchScore, OfNothingHasNoFigures) {
    const auto json = nlohmann::json::parse(json_of(score_touches({}, {})));
    EXPECT_EQ(json["contacts"], 0);
    EXPECT_TRUE(json["position_mm_mean"].is_null());
    EXPECT_TRUE(json["latency_frames_median"].is_null());
    EXPECT_FALSE(line_of(score_touches({}, {})).empty());
}

TEST(TouchScore, JsonHasTheFigures) {
    TouchTruth truth = one_finger({0, 0, 0, 50, 50, 50, 50, 50, 50, 50});
    const auto json = nlohmann::json::parse(
        json_of(score_touches(truth, {{1, {touch(1, 3.0)}}, {2, {touch(1, 5.0)}}, {8, {touch(9, 200.0)}}})));
    EXPECT_EQ(json["detection_rate"], 1.0);
    EXPECT_EQ(json["position_mm_mean"], 4.0);
    EXPECT_EQ(json["position_mm_p95"], 4.9);
    EXPECT_EQ(json["latency_frames_median"], 1.0);
    EXPECT_EQ(json["latency_ms_median"], 33.333);
    EXPECT_EQ(json["spurious_per_min"], 180.0) << "one in a third of a second";
    EXPECT_EQ(json["frame_precision"], 0.667);
    EXPECT_EQ(json["frame_recall"], 0.667);
}

}  // namespace
}  // namespace touchstone
