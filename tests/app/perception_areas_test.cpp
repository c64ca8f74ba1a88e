// A table with named areas, from camera to event log.
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/areas_file.hpp"
#include "app/perception.hpp"
#include "tests/support/temporary_folder.hpp"

namespace touchstone {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

const std::vector<Vector2f> left_half{{0.02f, 0.02f}, {0.48f, 0.02f}, {0.48f, 0.98f}, {0.02f, 0.98f}};

class PerceptionAreas : public testing::Test {
  protected:
    PerceptionAreas() {
        options_.config.sensor_uri = "sim:flat?hands=0&seed=3";
        options_.config.tuio.enabled = false;
        options_.config.areas_file = (folder_ / "areas.toml").string();
        options_.config.interaction.background.volume.size_vox = 64;
        options_.config.interaction.scan_frames = 4;
        options_.pace = Pace::step;
    }

    static TableFrame step_until(Perception& perception, const std::string& state) {
        for (int i = 0; i < 200; ++i) {
            std::optional<TableFrame> frame = perception.step();
            if (frame && frame->state == state) return *frame;
        }
        ADD_FAILURE() << "never " << state;
        return {};
    }
    /// What the panel shows after it has asked for these areas.
    TableFrame ask(Perception& perception, std::vector<AreaDraft> drafts) {
        TableWish wish;
        wish.operating.open = true;
        wish.operating.area_lists = ++lists_;
        wish.operating.areas = std::move(drafts);
        perception.take(wish);
        std::optional<TableFrame> frame = perception.step();
        if (!frame || !frame->operating) throw std::runtime_error("no frame for the operator");
        EXPECT_EQ(frame->operating->area_lists, lists_);
        return *frame;
    }
    /// Where the corners of an area lie in the scan.
    static std::vector<Vector3f> corners_g_m(const TableFrame& frame, std::size_t area) {
        std::vector<Vector3f> corners;
        for (const Vector3f& corner : frame.areas.at(area).corners_c_m)
            corners.push_back(frame.T_g_c * corner);
        return corners;
    }
    static float farthest_mm(const std::vector<Vector3f>& a, const std::vector<Vector3f>& b) {
        float farthest = a.size() == b.size() ? 0.f : 1e6f;
        for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
            farthest = std::max(farthest, 1000.f * (a[i] - b[i]).norm());
        return farthest;
    }

    const TemporaryFolder folder_;
    RunOptions options_;
    int lists_ = 0;
};

TEST_F(PerceptionAreas, TheOperatorMakesChangesAndRemovesThem) {
    Perception perception(options_);
    const TableFrame live = step_until(perception, "live");
    EXPECT_THAT(live.areas, IsEmpty());
    TableFrame frame =
        ask(perception, {{"", "", left_half}, {"", "paint", {{0.6f, 0.1f}, {0.9f, 0.1f}, {0.7f, 0.5f}}}});
    ASSERT_THAT(frame.areas, SizeIs(2));
    EXPECT_EQ(frame.areas[0].name, "area-1");
    EXPECT_EQ(frame.areas[1].name, "area-2");
    EXPECT_EQ(frame.areas[1].scene, "paint");
    EXPECT_THAT(frame.areas[1].triangles, SizeIs(3));
    const Vector2f corner = area_uv(frame.area, frame.areas[0].corners_c_m[2]);
    EXPECT_LT((corner - left_half[2]).norm(), 1e-3f);
    EXPECT_THAT(load_areas(options_.config.areas_file), SizeIs(2));

    frame = ask(perception, {{"area-2", "photos"}});
    ASSERT_THAT(frame.areas, SizeIs(1));
    EXPECT_EQ(frame.areas[0].scene, "photos");
    EXPECT_THAT(frame.areas[0].corners_c_m, SizeIs(3)) << "as they were";
    EXPECT_EQ(load_areas(options_.config.areas_file).at(0).scene, "photos");

    frame = ask(perception, {{"area-2", "photos"}, {"", "", left_half}});
    EXPECT_EQ(frame.areas.at(1).name, "area-1") << "which is free again";
    frame = ask(perception, {});
    EXPECT_THAT(frame.areas, IsEmpty());
    EXPECT_THAT(load_areas(options_.config.areas_file), IsEmpty());
}

TEST_F(PerceptionAreas, WhatCannotBeIsRefusedInWordsAndChangesNothing) {
    Perception perception(options_);
    step_until(perception, "live");
    ask(perception, {{"", "", left_half}});
    TableFrame frame = ask(perception, {{"", "", {{0.1f, 0.1f}, {0.9f, 0.9f}, {0.9f, 0.1f}, {0.1f, 0.9f}}}});
    EXPECT_THAT(frame.operating->areas, HasSubstr("do not cross"));
    ASSERT_THAT(frame.areas, SizeIs(1));
    EXPECT_EQ(frame.areas[0].name, "area-1");
    frame = ask(perception, {{"area-1", "nonsense"}});
    EXPECT_THAT(frame.operating->areas, HasSubstr("no scene nonsense"));
    std::filesystem::remove(options_.config.areas_file);
    std::filesystem::create_directory(options_.config.areas_file);
    frame = ask(perception, {});
    EXPECT_NE(frame.operating->areas, "") << "it cannot be written";
    EXPECT_THAT(frame.areas, SizeIs(1));
}

TEST_F(PerceptionAreas, AWrongFileIsSaidAndTheTableStarts) {
    std::ofstream(options_.config.areas_file) << "[[area]]\nname = \"a\"\n";
    Perception perception(options_);
    TableWish wish;
    wish.operating.open = true;
    perception.take(wish);
    const TableFrame live = step_until(perception, "live");
    EXPECT_THAT(live.areas, IsEmpty());
    ASSERT_TRUE(live.operating);
    EXPECT_THAT(live.operating->areas, HasSubstr("3 to 12 corners"));
    EXPECT_THAT(ask(perception, {{"", "", left_half}}).areas, SizeIs(1));
}

TEST_F(PerceptionAreas, WhereNothingIsKeptTheyAreShownAndStay) {
    const std::string text =
        "[[area]]\nname = \"left\"\ncorners_mm = [[-400, -400], [0, -400], [0, 200], [-400, 200]]\n";
    std::ofstream(options_.config.areas_file) << text;
    options_.keeps_nothing = true;
    Perception perception(options_);
    EXPECT_THAT(step_until(perception, "live").areas, SizeIs(1));
    const TableFrame frame = ask(perception, {});
    EXPECT_FALSE(frame.operating->can_change_areas);
    EXPECT_THAT(frame.areas, SizeIs(1));
    std::ifstream file(options_.config.areas_file);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), text);
}

TEST_F(PerceptionAreas, WithoutAFileNoneAreMade) {
    options_.config.areas_file.clear();
    Perception perception(options_);
    step_until(perception, "live");
    const TableFrame frame = ask(perception, {{"", "", left_half}});
    EXPECT_FALSE(frame.operating->can_change_areas);
    EXPECT_THAT(frame.areas, IsEmpty());
}

/// Each finger is in the area that its place on the table says.
TEST_F(PerceptionAreas, TouchesAreOfTheAreaInWhichTheyComeDown) {
    std::ofstream(options_.config.areas_file)
        << "[[area]]\nname = \"left\"\ncorners_mm = [[-2000, -2000], [0, -2000], [0, 2000], [-2000, 2000]]\n"
           "[[area]]\nname = \"right\"\ncorners_mm = [[0, -2000], [2000, -2000], [2000, 100], [0, 100]]\n";
    options_.config.sensor_uri = "sim:flat?hands=2&seed=5";
    options_.config.interaction = {};
    options_.events_file = folder_ / "events.jsonl";
    PlaneFrame plane;
    {
        Perception perception(options_);
        plane = plane_frame(step_until(perception, "live").area);
        for (int i = 0; i < 300; ++i) perception.step();
    }
    std::ifstream log(*options_.events_file);
    std::map<std::string, int> downs;
    int close = 0;
    for (std::string line; std::getline(log, line);) {
        const nlohmann::json told = nlohmann::json::parse(line);
        for (const nlohmann::json& touch : told["touches"]) {
            if (touch["phase"] != "down") continue;
            const auto& mm = touch["camera_mm"];
            const Vector2f place = place_mm(plane, 0.001f * Vector3f(mm[0], mm[1], mm[2]));
            const std::string expected = place.x() < 0.f ? "left" : place.y() < 100.f ? "right" : "";
            const std::string found = touch.value("area", "");
            const bool is_at_a_side = std::abs(place.x()) < 0.1f || std::abs(place.y() - 100.f) < 0.1f;
            close += is_at_a_side ? 1 : 0;
            if (!is_at_a_side) {
                EXPECT_EQ(found, expected) << place.transpose();
            }
            ++downs[found];
        }
    }
    EXPECT_LT(close, 2);
    EXPECT_GE(downs["left"], 2);
    EXPECT_GE(downs["right"], 2);
}

TEST_F(PerceptionAreas, ATouchEndsWhereTheAreasChange) {
    options_.config.sensor_uri = "sim:flat?hands=2&seed=5";
    options_.config.interaction = {};
    Perception perception(options_);
    step_until(perception, "live");
    std::vector<TouchEvent> touches;
    for (int i = 0; i < 300 && touches.empty(); ++i) {
        touches = perception.step()->touches;
        std::erase_if(touches, [](const TouchEvent& touch) { return touch.phase == TouchPhase::up; });
    }
    ASSERT_THAT(touches, SizeIs(1));
    const TableFrame frame = ask(perception, {{"", "", left_half}});
    ASSERT_THAT(frame.areas, SizeIs(1));
    for (const TouchEvent& touch : frame.touches)
        EXPECT_TRUE(touch.tip.id != touches[0].tip.id || touch.phase == TouchPhase::up);
}

TEST_F(PerceptionAreas, AfterAKnockTheyLieWhereTheyLay) {
    options_.config.sensor_uri = "sim:mixed?seed=3&hands=0&knock_s=2&knock_deg=3&knock_mm=20";
    options_.config.interaction.background.volume.size_vox = 256;
    options_.config.interaction.scan_frames = 20;
    Perception perception(options_);
    step_until(perception, "live");
    const TableFrame before = ask(perception, {{"", "", left_half}});
    const std::vector<NamedArea> written = load_areas(options_.config.areas_file);
    step_until(perception, "realigning");
    step_until(perception, "live");
    const TableFrame after = *perception.step();
    ASSERT_GT(1000.f * (before.T_g_c.translation() - after.T_g_c.translation()).norm(), 10.f) << "it moved";
    EXPECT_LT(farthest_mm(corners_g_m(before, 0), corners_g_m(after, 0)), 1.f) << "millimetres in the scan";
    const std::vector<NamedArea> rewritten = load_areas(options_.config.areas_file);
    EXPECT_GT((rewritten[0].corners_mm[0] - written[0].corners_mm[0]).norm(), 5.f)
        << "the file holds places as the camera stands now";
}

TEST_F(PerceptionAreas, AfterAKnockWhileItWasOffTheyLieWhereTheyLay) {
    options_.config.sensor_uri = "sim:mixed?seed=3&hands=0";
    options_.config.scan_file = (folder_ / "table.scan").string();
    options_.config.interaction.background.volume.size_vox = 256;
    options_.config.interaction.scan_frames = 20;
    std::vector<Vector3f> before;
    {
        Perception perception(options_);
        step_until(perception, "live");
        const std::vector<AreaDraft> drafts{
            {"", "", left_half}, {"", "", {{0.f, 0.3f}, {0.045f, 0.3f}, {0.045f, 0.5f}, {0.f, 0.5f}}}};
        before = corners_g_m(ask(perception, drafts), 0);
        perception.follow();
    }
    options_.config.sensor_uri += "&knock_s=0&knock_deg=8&knock_mm=20";
    Perception perception(options_);
    testing::internal::CaptureStderr();
    const TableFrame after = step_until(perception, "live");
    const std::string log = testing::internal::GetCapturedStderr();
    EXPECT_LT(farthest_mm(before, corners_g_m(after, 0)), 2.f) << "millimetres in the scan";
    EXPECT_THAT(log, HasSubstr("interactive area: "));
    EXPECT_THAT(log, Not(HasSubstr("lies outside"))) << "before it had followed, the narrow one would";
}

}  // namespace
}  // namespace touchstone
