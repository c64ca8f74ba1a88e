#include "app/reports.hpp"

#include <gtest/gtest.h>

#include "app/perception.hpp"

namespace touchstone {
namespace {

TEST(Reports, MetresBecomeMillimetres) {
    InteractionFrame frame;
    frame.state = InteractionState::live;
    Fingertip tip;
    tip.id = 4;
    tip.surface_c_m = {0.1f, -0.2f, 1.0f};
    tip.area_uv = {0.25f, 0.75f};
    tip.height_m = 0.021f;
    frame.touches.push_back({tip, TouchPhase::up});
    frame.hovers.push_back({tip});
    const TouchReport report = make_report(frame, 12, 400000);
    EXPECT_EQ(report.frame, 12);
    EXPECT_EQ(report.time_us, 400000u);
    EXPECT_EQ(report.state, "live");
    ASSERT_EQ(report.touches.size(), 1u);
    EXPECT_EQ(report.touches[0].phase, ReportedPhase::up);
    EXPECT_NEAR(report.touches[0].camera_mm[1], -200.0, 1e-3);
    EXPECT_NEAR(report.hovers.at(0).height_mm, 21.0, 1e-3);
    EXPECT_NEAR(report.hovers.at(0).surface[1], 0.75, 1e-6);
}

TEST(Reports, AHeldObjectIsReportedWhereOneIsLookedFor) {
    InteractionFrame frame;
    EXPECT_FALSE(make_report(frame, 0, 0).object);
    frame.held.emplace();
    frame.held->reason = "nothing is held";
    EXPECT_EQ(make_report(frame, 0, 0).object->state, "searching");
    EXPECT_EQ(make_report(frame, 0, 0).object->reason, "nothing is held");
    frame.held->state = HeldObjectState::tracked;
    frame.held->T_c_o =
        Eigen::Translation3f(0.1f, -0.2f, 1.0f) * Eigen::AngleAxisf(1.2870022f, Eigen::Vector3f::UnitY());
    const ReportedObject object = *make_report(frame, 0, 0).object;
    EXPECT_EQ(object.state, "tracked");
    EXPECT_NEAR(object.camera_mm[1], -200.0, 1e-3);
    EXPECT_NEAR(object.quaternion[1], 0.6, 1e-6);
    EXPECT_NEAR(object.quaternion[3], 0.8, 1e-6);
    frame.held->state = HeldObjectState::lost;
    EXPECT_EQ(make_report(frame, 0, 0).object->state, "lost");
}

TEST(Reports, TouchesOfAFrameThatWasNeverDrawnAreKept) {
    TableFrame old, newer;
    old.index = 1, newer.index = 2;
    old.touches.push_back({{.id = 1}, TouchPhase::down});
    newer.touches.push_back({{.id = 1}, TouchPhase::up});
    const TableFrame merged = merge_frames(std::move(old), std::move(newer));
    EXPECT_EQ(merged.index, 2);
    ASSERT_EQ(merged.touches.size(), 2u);
    EXPECT_EQ(merged.touches[0].phase, TouchPhase::down);
    EXPECT_EQ(merged.touches[1].phase, TouchPhase::up);
}

}  // namespace
}  // namespace touchstone
