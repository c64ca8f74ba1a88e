#include "ui/canvas_fade.hpp"

#include <algorithm>
#include <imgui.h>

namespace touchstone {

void fade(Canvas& canvas, float opacity) {
    const float share = std::clamp(opacity, 0.f, 1.f);
    for (ImDrawVert& vertex : canvas.list().VtxBuffer) {
        const float alpha = share * static_cast<float>(vertex.col >> IM_COL32_A_SHIFT);
        vertex.col = (vertex.col & ~IM_COL32_A_MASK) | static_cast<ImU32>(alpha) << IM_COL32_A_SHIFT;
    }
}

}  // namespace touchstone
