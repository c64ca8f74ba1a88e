#pragma once

#include <memory>

#include "platform/display/picture.hpp"
#include "ui/table_frame.hpp"

namespace touchstone {

struct ViewFromAboveConfig {
    float px_per_mm = 1.f;  ///< fewer where the picture would have more than `most_px`
    int most_px = 1600;     ///< across, and down
};

/// A pinhole so far above the middle of the interactive area that it is nearly orthographic: what is drawn
/// straight or round in its picture is so on the surface, as seen from above. The area fills the picture, its
/// u axis runs to the right. Frame v: x right, y down, z towards the area.
struct ViewFromAbove {
    Intrinsics intrinsics{};  ///< width 0: no view yet
    RigidTransform T_g_v = RigidTransform::Identity();
    InteractiveArea area_g;
    std::shared_ptr<const ShadedView> black;  ///< an empty picture of that size, all background

    PixelSize size_px() const { return {intrinsics.width_px, intrinsics.height_px}; }
};

/// Of the area of a camera's frame.
ViewFromAbove make_view_from_above(const InteractiveArea& area, const RigidTransform& T_g_c,
                                   const ViewFromAboveConfig& config = {});

/// Whether the frame's area is still the view's, to a millimetre. False for a frame without area.
bool is_view_of(const ViewFromAbove& view, const TableFrame& frame);

/// The same frame as if the view were the depth camera's: all places and frames of `told` are moved into it.
/// Its picture is black, for a projector does not show the table; rendered pictures, which are the camera's,
/// are left out. A frame without area or intrinsics keeps the black picture and has no places.
TableFrame seen_from_above(const TableFrame& told, const ViewFromAbove& view);

}  // namespace touchstone
