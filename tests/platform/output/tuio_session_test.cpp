#include "platform/output/tuio_session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <set>

#include "tests/platform/output/tuio_reference_client.hpp"

namespace touchstone {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr auto down = ReportedPhase::down;
constexpr auto move = ReportedPhase::move;
constexpr auto up = ReportedPhase::up;

ReportedFinger finger(int id, ReportedPhase phase, double u = 0.5, double v = 0.5) {
    return {.id = id, .phase = phase, .camera_mm = {}, .surface = {u, v}, .height_mm = 0.0};
}

/// A session after its start, with frames at 30 Hz.
class TuioSessionTest : public testing::Test {
  protected:
    TuioSessionTest() { session_.start(now_); }

    TuioSession::Bundles frame(std::vector<ReportedFinger> touches) {
        now_ += std::chrono::microseconds(33'333);
        const TouchReport report{.frame = count_,
                                 .time_us = static_cast<std::uint64_t>(count_) * 33'333,
                                 .state = "live",
                                 .touches = std::move(touches),
                                 .hovers = {}};
        ++count_;
        return session_.frame(report, now_);
    }

    TuioSession::Clock::time_point now_{std::chrono::hours(1)};
    int count_ = 0;
    TuioSession session_{TuioStart{.fseq = 1000, .session = 7}};
};

TEST_F(TuioSessionTest, ATouchIsAddedMovedAndRemoved) {
    auto said = frame({finger(3, down, 0.25, 0.75)});
    ASSERT_THAT(said, SizeIs(1));
    EXPECT_THAT(said[0].alive, ElementsAre(7));
    ASSERT_THAT(said[0].cursors, SizeIs(1));
    EXPECT_FLOAT_EQ(said[0].cursors[0].x, 0.25f);
    EXPECT_FLOAT_EQ(said[0].cursors[0].y, 0.75f);
    const std::int32_t first = said[0].fseq;
    said = frame({finger(3, move, 0.26, 0.75)});
    ASSERT_THAT(said, SizeIs(1));
    EXPECT_EQ(said[0].fseq, first + 1);
    said = frame({finger(3, up, 0.26, 0.75)});
    ASSERT_THAT(said, SizeIs(2)) << "an emptied table is said twice";
    EXPECT_THAT(said[0].alive, IsEmpty());
    EXPECT_EQ(said[0].fseq, first + 2);
    EXPECT_THAT(said[1].alive, IsEmpty());
    EXPECT_EQ(said[1].fseq, -1);
}

TEST_F(TuioSessionTest, VelocityIsInWidthsASecondAndAccelerationItsGrowth) {
    frame({finger(1, down, 0.50, 0.50)});
    auto said = frame({finger(1, move, 0.53, 0.54)});
    const double dt_s = 0.033333;
    ASSERT_THAT(said, SizeIs(1));
    // Single precision of the places: 1e-7 / 33 ms, and once more for the acceleration.
    EXPECT_NEAR(said[0].cursors[0].velocity_x, 0.03 / dt_s, 1e-5);
    EXPECT_NEAR(said[0].cursors[0].velocity_y, 0.04 / dt_s, 1e-5);
    EXPECT_NEAR(said[0].cursors[0].acceleration, 0.05 / dt_s / dt_s, 1e-3);
    said = frame({finger(1, move, 0.56, 0.58)});
    EXPECT_NEAR(said[0].cursors[0].acceleration, 0.0, 1e-3) << "constant speed";
    said = frame({finger(1, move, 0.56, 0.58)});
    EXPECT_FLOAT_EQ(said[0].cursors[0].velocity_x, 0.f);
    EXPECT_NEAR(said[0].cursors[0].acceleration, -0.05 / dt_s / dt_s, 1e-3);
}

TEST_F(TuioSessionTest, AFingerThatTouchesAgainIsANewSession) {
    TuioReferenceClient client;
    client.take(frame({finger(3, down)}));
    client.take(frame({finger(3, move)}));
    client.take(frame({finger(3, up)}));
    client.take(frame({finger(3, down)}));
    EXPECT_THAT(client.events, ElementsAre("add 7", "remove 7", "add 8"));
}

TEST_F(TuioSessionTest, ATapWithinOneReportEndsInABundleOfItsOwn) {
    frame({finger(1, down)});
    const auto said = frame({finger(1, move), finger(2, down, 0.1, 0.1), finger(2, up, 0.1, 0.1)});
    ASSERT_THAT(said, SizeIs(3));
    EXPECT_THAT(said[0].alive, ElementsAre(7, 8));
    EXPECT_THAT(said[1].alive, ElementsAre(7, 8));
    EXPECT_EQ(said[1].fseq, -1);
    EXPECT_THAT(said[2].alive, ElementsAre(7));
    EXPECT_EQ(said[2].fseq, said[0].fseq + 1);
}

TEST_F(TuioSessionTest, AnUpAndADownOfOneFingerInOneReportAreTwoSessions) {
    frame({finger(1, down)});
    frame({finger(1, move)});
    const auto said = frame({finger(1, up), finger(1, down)});
    ASSERT_THAT(said, SizeIs(1));
    EXPECT_THAT(said[0].alive, ElementsAre(8));
}

TEST_F(TuioSessionTest, ATouchThatIsNoLongerReportedIsOver) {
    TuioReferenceClient client;
    client.take(frame({finger(1, down)}));
    client.take(frame({}));
    EXPECT_THAT(client.cursors, IsEmpty());
}

TEST_F(TuioSessionTest, AMoveWithoutADownBeginsATouchAndAnUpWithoutOneIsNothing) {
    TuioReferenceClient client;
    client.take(frame({finger(5, move), finger(6, up)}));
    EXPECT_THAT(client.events, ElementsAre("add 7"));
}

TEST_F(TuioSessionTest, PlacesOutsideTheAreaAreItsEdge) {
    const auto said = frame({finger(1, down, -0.2, 1.3)});
    EXPECT_FLOAT_EQ(said[0].cursors[0].x, 0.f);
    EXPECT_FLOAT_EQ(said[0].cursors[0].y, 1.f);
}

TEST_F(TuioSessionTest, AliveIsSaidBeforeASecondOfSilenceIsOver) {
    for (int i = 0; i < 10; ++i) frame({});
    auto last = now_;
    for (int i = 0; i < 100; ++i) {
        const auto said = frame({});
        if (said.empty()) continue;
        EXPECT_EQ(said[0].fseq, -1);
        EXPECT_THAT(said[0].alive, IsEmpty());
        EXPECT_LE(now_ - last, milliseconds(1000));
        last = now_;
    }
    EXPECT_LE(now_ - last, milliseconds(1000));
    EXPECT_THAT(session_.refresh(last + milliseconds(500)), IsEmpty());
    EXPECT_THAT(session_.refresh(last + milliseconds(1000)), SizeIs(1));
}

TEST_F(TuioSessionTest, ReleaseSaysTheEmptyTableTwiceAndKeepsCounting) {
    const std::int32_t before = frame({finger(1, down)})[0].fseq;
    const auto said = session_.release_all(now_);
    ASSERT_THAT(said, SizeIs(3)) << "the touch was said once, so it is repeated before it ends";
    EXPECT_THAT(said[0].alive, ElementsAre(7));
    EXPECT_THAT(said[1].alive, IsEmpty());
    EXPECT_EQ(said[1].fseq, before + 1);
    EXPECT_THAT(said[2].alive, IsEmpty());
}

/// A session of 25Dcur that says 1 for 100 mm, with frames at 30 Hz.
class TuioHoverTest : public testing::Test {
  protected:
    TuioHoverTest() { session_.start(now_); }

    TuioCursor cursor_of(std::vector<ReportedFinger> touches, std::vector<ReportedFinger> hovers) {
        const auto said = frame(std::move(touches), std::move(hovers));
        if (said.empty() || said[0].cursors.size() != 1) {
            ADD_FAILURE() << "no cursor, or several";
            return {};
        }
        return said[0].cursors[0];
    }
    TuioSession::Bundles frame(std::vector<ReportedFinger> touches, std::vector<ReportedFinger> hovers) {
        ++count_;
        now_ += std::chrono::microseconds(33'333);
        return session_.frame({.frame = count_,
                               .time_us = static_cast<std::uint64_t>(count_) * 33'333,
                               .state = "live",
                               .touches = std::move(touches),
                               .hovers = std::move(hovers)},
                              now_);
    }
    static ReportedFinger at_height(double height_mm, ReportedPhase phase = down) {
        return {.id = 3, .phase = phase, .surface = {0.5, 0.5}, .height_mm = height_mm};
    }

    TuioSession::Clock::time_point now_{std::chrono::hours(1)};
    int count_ = 0;
    TuioSession session_{TuioStart{.fseq = 1000, .session = 7}, 100.0};
};

TEST_F(TuioHoverTest, AFingerKeepsItsSessionFromHoverToTouchAndBack) {
    EXPECT_FLOAT_EQ(cursor_of({}, {at_height(80)}).z, 0.8f);
    EXPECT_FLOAT_EQ(cursor_of({at_height(0.4, down)}, {}).z, 0.f) << "in contact, whatever was measured";
    EXPECT_FLOAT_EQ(cursor_of({at_height(0.4, move)}, {}).z, 0.f);
    EXPECT_FLOAT_EQ(cursor_of({at_height(12, up)}, {}).z, 0.12f);
    const TuioCursor last = cursor_of({}, {at_height(30)});
    EXPECT_FLOAT_EQ(last.z, 0.3f);
    EXPECT_EQ(last.session, 7);
    EXPECT_THAT(frame({}, {})[0].alive, IsEmpty());
}

TEST_F(TuioHoverTest, HeightHasAVelocityAndIsOneAtMost) {
    cursor_of({}, {at_height(60)});
    const TuioCursor rising = cursor_of({}, {at_height(90)});
    EXPECT_NEAR(rising.velocity_z, 0.3 / 0.033333, 1e-4);
    EXPECT_NEAR(rising.acceleration, 0.3 / 0.033333 / 0.033333, 1e-2);
    EXPECT_FLOAT_EQ(cursor_of({}, {at_height(250)}).z, 1.f);
}

TEST_F(TuioHoverTest, ATapWithinAReportIsDownForAFrame) {
    cursor_of({}, {at_height(20)});
    const auto said = frame({at_height(0.3, down), at_height(4, up)}, {});
    ASSERT_THAT(said, SizeIs(1));
    EXPECT_THAT(said[0].alive, ElementsAre(7)) << "still over the surface";
}

TEST_F(TuioSessionTest, HoversAreNoCursorsOf2Dcur) {
    ++count_;
    const TouchReport report{.state = "live", .touches = {}, .hovers = {finger(1, down)}};
    EXPECT_THAT(session_.frame(report, now_), IsEmpty());
}

TEST(TuioSessionStart, IsTakenByAClientWithAnyCountAndClearsItsCursors) {
    const TuioSession::Clock::time_point now{};
    for (std::int32_t seen = 800; seen <= 1300; ++seen) {
        for (const int lost : {-1, 0, 1, 2}) {
            TuioReferenceClient client;
            client.current_frame = seen;
            client.cursors[3] = {};
            TuioSession session({.fseq = 1000, .session = 9});
            auto said = session.start(now);
            ASSERT_THAT(said, SizeIs(3));
            if (lost >= 0) said.erase(said.begin() + lost);
            client.take(said);
            EXPECT_THAT(client.cursors, IsEmpty()) << seen;
            // With the frame in the middle lost, only the clock keeps the counts apart.
            if (lost == 1) continue;
            TouchReport report;
            report.touches = {finger(1, down)};
            client.take(session.frame(report, now));
            EXPECT_THAT(client.cursors, SizeIs(1)) << "client at " << seen << ", lost " << lost;
        }
    }
}

TEST(TuioSessionStart, FollowsTheClockFasterThanFramesAndTaps) {
    const std::chrono::system_clock::time_point then{std::chrono::hours(24 * 365 * 57)};
    const TuioStart first = tuio_start(then);
    const TuioStart later = tuio_start(then + std::chrono::seconds(10));
    EXPECT_NEAR(later.fseq - first.fseq, 10'240, 1);
    EXPECT_NEAR(later.session - first.session, 320, 1);
    for (int day = 0; day < 100; ++day) {
        const TuioStart start = tuio_start(then + std::chrono::hours(24 * day));
        EXPECT_GE(start.fseq, 1);
        EXPECT_GE(start.session, 1);
    }
}

TEST(TuioSessionStart, CountersGoRoundBelowZeroNever) {
    const TuioSession::Clock::time_point now{};
    constexpr std::int32_t largest = std::numeric_limits<std::int32_t>::max();
    TuioSession session({.fseq = largest - 102, .session = largest});
    TuioReferenceClient client;
    client.take(session.start(now));
    TouchReport report;
    for (int id = 0; id < 5; ++id) {
        report.touches = {finger(id, down)};
        client.take(session.frame(report, now));
        EXPECT_THAT(client.cursors, SizeIs(1));
        EXPECT_GE(client.cursors.begin()->first, 1);
    }
    EXPECT_EQ(client.dropped, 0);
}

/// Random fingers over a channel that loses every third datagram.
TEST_F(TuioSessionTest, ALossyChannelHidesFewTouchesAndLeavesNoneStuck) {
    std::mt19937 random(42);
    std::bernoulli_distribution loses(0.3), begins(0.2), ends(0.3);
    TuioReferenceClient client;
    std::set<int> fingers;
    int begun = 0;
    for (int i = 0; i < 3000; ++i) {
        std::vector<ReportedFinger> touches;
        for (int id = 0; id < 5; ++id) {
            if (fingers.contains(id)) {
                const bool over = ends(random);
                touches.push_back(finger(id, over ? up : move));
                if (over) fingers.erase(id);
            } else if (begins(random)) {
                touches.push_back(finger(id, down));
                fingers.insert(id);
                ++begun;
            }
        }
        for (const TuioBundle& bundle : frame(touches)) {
            if (!loses(random)) client.take(bundle);
        }
    }
    for (int i = 0; i < 60; ++i) client.take(frame({}));
    EXPECT_THAT(client.cursors, IsEmpty());
    const auto added = std::count_if(client.events.begin(), client.events.end(),
                                     [](const std::string& event) { return event.starts_with("add"); });
    // A touch is said twice at least, most of them more often: 0.3^2 of the shortest ones are lost.
    EXPECT_GT(static_cast<double>(added), 0.95 * begun);
    EXPECT_LE(added, begun) << "none is seen twice";
    EXPECT_EQ(client.dropped, 0);
}

}  // namespace
}  // namespace touchstone
