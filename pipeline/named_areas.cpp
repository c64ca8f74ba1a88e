#include "pipeline/named_areas.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <utility>

namespace touchstone {

namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float least_side_mm = 20.f, least_width_mm = 40.f;

/// Twice the area of a triangle; its sign tells on which side of a to b the point lies.
float turn(const Vector2f& a, const Vector2f& b, const Vector2f& p) {
    const Vector2f along = b - a, to = p - a;
    return along.x() * to.y() - along.y() * to.x();
}

bool cross(const Vector2f& a, const Vector2f& b, const Vector2f& c, const Vector2f& d) {
    return turn(a, b, c) * turn(a, b, d) <= 0.f && turn(c, d, a) * turn(c, d, b) <= 0.f;
}

bool sides_cross(const Polygon& polygon) {
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = i + 2; j < n; ++j) {
            if (i == 0 && j == n - 1) continue;
            if (cross(polygon[i], polygon[i + 1], polygon[j], polygon[(j + 1) % n])) return true;
        }
    }
    return false;
}

float doubled_area(const Polygon& polygon) {
    float sum = 0.f;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vector2f& a = polygon[i];
        const Vector2f& b = polygon[(i + 1) % polygon.size()];
        sum += a.x() * b.y() - a.y() * b.x();
    }
    return sum;
}

Eigen::AlignedBox2f box_of(const Polygon& polygon) {
    Eigen::AlignedBox2f box;
    for (const Vector2f& corner : polygon) box.extend(corner);
    return box;
}

}  // namespace

PlaneFrame plane_frame(const InteractiveArea& area) {
    const Vector3f normal = facing_normal(area);
    PlaneFrame plane;
    plane.origin_c_m = Vector3f(0.f, 0.f, normal.dot(area.origin_c_m) / normal.z());
    plane.x_c = (Vector3f::UnitX() - normal.x() * normal).normalized();
    plane.y_c = plane.x_c.cross(normal);
    return plane;
}

Vector2f place_mm(const PlaneFrame& plane, const Vector3f& point_c_m) {
    const Vector3f offset = point_c_m - plane.origin_c_m;
    return 1000.f * Vector2f(offset.dot(plane.x_c), offset.dot(plane.y_c));
}

Vector3f point_c_m(const PlaneFrame& plane, const Vector2f& place_mm) {
    return plane.origin_c_m + 0.001f * (place_mm.x() * plane.x_c + place_mm.y() * plane.y_c);
}

std::string fault_of(const Polygon& polygon) {
    const std::size_t n = polygon.size();
    if (n < fewest_area_corners || n > most_area_corners)
        return fmt::format("an area has {} to {} corners", fewest_area_corners, most_area_corners);
    for (std::size_t i = 0; i < n; ++i)
        if ((polygon[i] - polygon[(i + 1) % n]).norm() < least_side_mm)
            return "corners of an area are at least 20 mm apart";
    if (sides_cross(polygon)) return "the sides of an area do not cross: its corners come in order around it";
    if (box_of(polygon).sizes().minCoeff() < least_width_mm) return "an area is at least 40 mm wide and high";
    return {};
}

bool is_inside(const Polygon& polygon, const Vector2f& place_mm) {
    bool inside = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vector2f& a = polygon[i];
        const Vector2f& b = polygon[(i + 1) % polygon.size()];
        if ((a.y() > place_mm.y()) == (b.y() > place_mm.y())) continue;
        const float x = a.x() + (place_mm.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
        if (place_mm.x() < x) inside = !inside;
    }
    return inside;
}

std::vector<int> triangles_of(const Polygon& polygon) {
    std::vector<int> left(polygon.size()), triangles;
    std::iota(left.begin(), left.end(), 0);
    if (doubled_area(polygon) < 0.f) std::ranges::reverse(left);
    const auto at = [&](int corner) -> const Vector2f& { return polygon[static_cast<std::size_t>(corner)]; };
    const auto is_ear = [&](int a, int b, int c) {
        if (turn(at(a), at(b), at(c)) <= 0.f) return false;
        return std::ranges::none_of(left, [&](int other) {
            if (other == a || other == b || other == c) return false;
            const Vector2f& p = at(other);
            return turn(at(a), at(b), p) >= 0.f && turn(at(b), at(c), p) >= 0.f &&
                   turn(at(c), at(a), p) >= 0.f;
        });
    };
    while (left.size() >= 3) {
        const std::size_t n = left.size();
        std::size_t ear = 0;
        while (ear < n && !is_ear(left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n])) ++ear;
        ear %= n;  // of a polygon without fault there is one; corners on one line are dropped so
        triangles.insert(triangles.end(), {left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    return triangles;
}

InteractiveArea bounding_area(const PlaneFrame& plane, const Polygon& polygon) {
    const Eigen::AlignedBox2f box = box_of(polygon);
    return {point_c_m(plane, box.min()), 0.001f * box.sizes().x() * plane.x_c,
            0.001f * box.sizes().y() * plane.y_c};
}

std::vector<NamedArea> moved(std::vector<NamedArea> areas, const PlaneFrame& before,
                             const RigidTransform& T_new_old, const PlaneFrame& after) {
    for (NamedArea& area : areas)
        for (Vector2f& corner : area.corners_mm)
            corner = place_mm(after, T_new_old * point_c_m(before, corner));
    return areas;
}

int AreaAssignment::area_at(const Vector2f& place_mm) const {
    for (std::size_t i = 0; i < areas_.size(); ++i)
        if (is_inside(areas_[i].corners_mm, place_mm)) return static_cast<int>(i);
    return -1;
}

void AreaAssignment::assign(const InteractiveArea& table, std::vector<TouchEvent>& touches,
                            std::vector<HoverEvent>& hovers) {
    const PlaneFrame plane = plane_frame(table);
    const auto put = [&](Fingertip& tip, int area) {
        tip.area = area;
        if (area < 0) return;
        const NamedArea& named = areas_[static_cast<std::size_t>(area)];
        tip.named_uv = area_uv(bounding_area(plane, named.corners_mm), tip.surface_c_m);
    };
    const std::map<int, int> before = std::exchange(touching_, {});
    for (TouchEvent& touch : touches) {
        const auto known = before.find(touch.tip.id);
        const bool begins = touch.phase == TouchPhase::down || known == before.end();
        put(touch.tip, begins ? area_at(place_mm(plane, touch.tip.surface_c_m)) : known->second);
        if (touch.phase != TouchPhase::up) touching_[touch.tip.id] = touch.tip.area;
    }
    for (HoverEvent& hover : hovers) put(hover.tip, area_at(place_mm(plane, hover.tip.surface_c_m)));
}

}  // namespace touchstone
