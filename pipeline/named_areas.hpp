#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/touch_event.hpp"
#include "pipeline/types.hpp"

namespace touchstone {

/// Corners in order around it, millimetres on the main plane.
using Polygon = std::vector<Eigen::Vector2f>;

/// Places on the plane of the interactive area: x to the right and y down as the camera sees it, from where
/// the camera's axis meets it. Does not depend on how large the area is, and so is the same after each scan.
struct PlaneFrame {
    Eigen::Vector3f origin_c_m{0.f, 0.f, 1.f};
    Eigen::Vector3f x_c{1.f, 0.f, 0.f}, y_c{0.f, 1.f, 0.f};  ///< length 1
};

PlaneFrame plane_frame(const InteractiveArea& area);
/// Of the foot of a point's plumb line.
Eigen::Vector2f place_mm(const PlaneFrame& plane, const Eigen::Vector3f& point_c_m);
Eigen::Vector3f point_c_m(const PlaneFrame& plane, const Eigen::Vector2f& place_mm);

/// What is wrong with a polygon, in words for whoever made it; empty where nothing is: 3 to 12 corners, 20 mm
/// apart, no sides that cross, at least 40 mm across in both directions.
std::string fault_of(const Polygon& polygon);
/// A point on its side may be either.
bool is_inside(const Polygon& polygon, const Eigen::Vector2f& place_mm);
/// Its triangles, corner numbers three by three (ear clipping). Of a polygon without fault.
std::vector<int> triangles_of(const Polygon& polygon);
/// The upright rectangle about a polygon, as an area.
InteractiveArea bounding_area(const PlaneFrame& plane, const Polygon& polygon);

/// A part of the table with a scene and listeners of its own.
struct NamedArea {
    std::string name;
    std::string scene;   ///< empty: the table's
    std::string source;  ///< of TUIO; empty: touchstone-NAME@ and the host's name
    Polygon corners_mm;
};

/// The same places on the surface for a camera that stands elsewhere.
std::vector<NamedArea> moved(std::vector<NamedArea> areas, const PlaneFrame& before,
                             const RigidTransform& T_new_old, const PlaneFrame& after);

/// To which area each finger belongs. One that touches keeps the area in which it came down until it is up;
/// of areas that overlap the first counts.
class AreaAssignment {
  public:
    AreaAssignment() = default;
    explicit AreaAssignment(std::vector<NamedArea> areas) : areas_(std::move(areas)) {}

    const std::vector<NamedArea>& areas() const { return areas_; }
    /// Writes area and its u and v of all tips of a frame; -1 for those outside all areas.
    void assign(const InteractiveArea& table, std::vector<TouchEvent>& touches,
                std::vector<HoverEvent>& hovers);

  private:
    int area_at(const Eigen::Vector2f& place_mm) const;

    std::vector<NamedArea> areas_;
    std::map<int, int> touching_;  // area of each finger that is down
};

}  // namespace touchstone
