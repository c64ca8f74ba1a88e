#include "pipeline/named_areas.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

namespace touchstone {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;
using testing::HasSubstr;
using testing::IsEmpty;

const Polygon square{{0, 0}, {100, 0}, {100, 100}, {0, 100}};
/// An arrow's head, open to the right.
const Polygon dented{{0, 0}, {200, 0}, {80, 100}, {200, 200}, {0, 200}};

/// 600 x 400 mm, 1 m below a camera that looks 30 degrees away from straight down.
InteractiveArea tilted_table() {
    const RigidTransform turn(Eigen::AngleAxisf(-0.5236f, Vector3f::UnitX()));
    return {turn * Vector3f(-0.3f, -0.2f, 0.f) + Vector3f(0.f, 0.f, 1.f), turn * Vector3f(0.6f, 0.f, 0.f),
            turn * Vector3f(0.f, 0.4f, 0.f)};
}

TEST(Polygon, InsideIsWhatTheSidesEnclose) {
    EXPECT_TRUE(is_inside(square, {50, 50}));
    EXPECT_FALSE(is_inside(square, {101, 50}));
    EXPECT_FALSE(is_inside(square, {50, -1}));
    EXPECT_TRUE(is_inside(dented, {40, 100}));
    EXPECT_FALSE(is_inside(dented, {150, 100})) << "in the dent";
    EXPECT_TRUE(is_inside(dented, {150, 20}));
}

TEST(Polygon, FaultsAreNamed) {
    EXPECT_THAT(fault_of(square), IsEmpty());
    EXPECT_THAT(fault_of(dented), IsEmpty());
    EXPECT_THAT(fault_of({{0, 0}, {100, 0}}), HasSubstr("3 to 12 corners"));
    Polygon many;
    for (int i = 0; i < 13; ++i)
        many.emplace_back(500.f * std::cos(0.48f * static_cast<float>(i)),
                          500.f * std::sin(0.48f * static_cast<float>(i)));
    EXPECT_THAT(fault_of(many), HasSubstr("3 to 12 corners"));
    EXPECT_THAT(fault_of({{0, 0}, {100, 0}, {100, 10}, {0, 100}}), HasSubstr("20 mm apart"));
    EXPECT_THAT(fault_of({{0, 0}, {100, 100}, {100, 0}, {0, 100}}), HasSubstr("do not cross"));
    EXPECT_THAT(fault_of({{0, 0}, {100, 0}, {100, 30}, {0, 30}}), HasSubstr("40 mm"));
}

/// Either way around, from whichever corner: the triangles cover the polygon once, and nothing else.
TEST(Polygon, TrianglesCoverItOnce) {
    std::vector<Polygon> polygons{square, dented, {dented.rbegin(), dented.rend()}};
    for (int i = 0; i < 4; ++i) {
        polygons.push_back(polygons.back());
        std::ranges::rotate(polygons.back(), polygons.back().begin() + 1);
    }
    for (const Polygon& polygon : polygons) {
        const std::vector<int> triangles = triangles_of(polygon);
        ASSERT_EQ(triangles.size(), 3 * (polygon.size() - 2));
        int inside = 0, wrong = 0;
        for (float y = -9.5f; y < 210.f; y += 4.f) {
            for (float x = -9.5f; x < 210.f; x += 4.f) {
                int covers = 0;
                for (std::size_t i = 0; i < triangles.size(); i += 3) {
                    const auto corner = [&](std::size_t k) {
                        return polygon[static_cast<std::size_t>(triangles[i + k])];
                    };
                    covers += is_inside({corner(0), corner(1), corner(2)}, {x, y});
                }
                inside += is_inside(polygon, {x, y});
                wrong += covers != is_inside(polygon, {x, y});
            }
        }
        EXPECT_GT(inside, 500);
        EXPECT_EQ(wrong, 0);
    }
}

TEST(PlaneFrame, PlacesAreMillimetresFromTheMiddleOfTheViewAndComeBack) {
    const InteractiveArea table = tilted_table();
    const PlaneFrame plane = plane_frame(table);
    EXPECT_NEAR((plane.origin_c_m - Vector3f(0.f, 0.f, 1.f)).norm(), 0.f, 1e-5f);
    EXPECT_LT((place_mm(plane, table.origin_c_m) - Vector2f(-300.f, -200.f)).norm(), 0.01f);
    EXPECT_LT((place_mm(plane, table.origin_c_m + table.axis_u_c_m) - Vector2f(300.f, -200.f)).norm(), 0.01f);
    EXPECT_LT((point_c_m(plane, {-300.f, -200.f}) - table.origin_c_m).norm(), 1e-5f);
    const Vector3f above = table.origin_c_m + 0.08f * facing_normal(table);
    EXPECT_LT((place_mm(plane, above) - Vector2f(-300.f, -200.f)).norm(), 0.01f) << "of its foot";
    InteractiveArea smaller = table;
    smaller.origin_c_m += 0.1f * table.axis_u_c_m;
    EXPECT_LT((place_mm(plane_frame(smaller), table.origin_c_m) - Vector2f(-300.f, -200.f)).norm(), 0.01f);
}

TEST(NamedAreas, StayWhereTheyAreWhenTheCameraMoves) {
    const InteractiveArea table = tilted_table();
    RigidTransform T_new_old = RigidTransform::Identity();
    T_new_old.translation() = Vector3f(0.02f, -0.03f, 0.01f);
    T_new_old.rotate(Eigen::AngleAxisf(0.05f, Vector3f(1.f, 2.f, 0.5f).normalized()));
    const InteractiveArea table_after = transformed(T_new_old, table);
    const auto after =
        moved({{"a", "", "", square}}, plane_frame(table), T_new_old, plane_frame(table_after));
    for (std::size_t i = 0; i < square.size(); ++i) {
        const Vector3f was = T_new_old * point_c_m(plane_frame(table), square[i]);
        EXPECT_LT((point_c_m(plane_frame(table_after), after[0].corners_mm[i]) - was).norm(), 1e-5f)
            << "metres";
    }
}

class Assignment : public testing::Test {
  protected:
    TouchEvent touch(int id, TouchPhase phase, const Vector2f& at_mm) const {
        TouchEvent event;
        event.tip.id = id;
        event.tip.surface_c_m = point_c_m(plane_frame(table_), at_mm);
        event.phase = phase;
        return event;
    }
    Fingertip after(int id, TouchPhase phase, const Vector2f& at_mm) {
        std::vector<TouchEvent> touches{touch(id, phase, at_mm)};
        std::vector<HoverEvent> none;
        assignment_.assign(table_, touches, none);
        return touches[0].tip;
    }

    const InteractiveArea table_ = tilted_table();
    AreaAssignment assignment_{{{"left", "", "", {{-300, -200}, {0, -200}, {0, 200}, {-300, 200}}},
                                {"right", "", "", {{0, -200}, {300, -200}, {300, 200}, {0, 200}}}}};
};

TEST_F(Assignment, ATouchKeepsTheAreaInWhichItCameDown) {
    using enum TouchPhase;
    EXPECT_EQ(after(1, down, {-20, 0}).area, 0);
    const Fingertip dragged = after(1, move, {50, 0});
    EXPECT_EQ(dragged.area, 0);
    EXPECT_NEAR(dragged.named_uv.x(), 350.f / 300.f, 1e-4f) << "beyond its right edge";
    EXPECT_EQ(after(1, up, {50, 0}).area, 0);
    EXPECT_EQ(after(1, down, {50, 0}).area, 1);
    EXPECT_NEAR(after(1, move, {75, 100}).named_uv.x(), 0.25f, 1e-4f);
    EXPECT_NEAR(after(1, move, {75, 100}).named_uv.y(), 0.75f, 1e-4f);
}

TEST_F(Assignment, OutsideIsNobodys) {
    using enum TouchPhase;
    EXPECT_EQ(after(2, down, {-400, 0}).area, -1);
    EXPECT_EQ(after(2, move, {-100, 0}).area, -1) << "until it is up";
    EXPECT_EQ(after(2, up, {-100, 0}).area, -1);
    std::vector<TouchEvent> none;
    std::vector<HoverEvent> hovers{{touch(3, move, {-100, 0}).tip}, {touch(4, move, {400, 0}).tip}};
    assignment_.assign(table_, none, hovers);
    EXPECT_EQ(hovers[0].tip.area, 0);
    EXPECT_EQ(hovers[1].tip.area, -1);
}

}  // namespace
}  // namespace touchstone
