#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "platform/display/gl_framebuffer.hpp"
#include "platform/display/gl_program.hpp"
#include "ui/instanced_quads.hpp"
#include "ui/stroke_path.hpp"
#include "ui/style.hpp"

namespace touchstone {

/// How pieces of a stroke are drawn.
struct StrokeLook {
    style::Color color;
    float radius_px = 0.f;  ///< of the depth picture
    bool erases = false;
};

/// Paint that stays: pieces of strokes are drawn once into a picture that covers the view, so that a frame
/// costs the same however much has been painted. Row 0 is the top; premultiplied alpha.
class StrokeLayer {
  public:
    /// For a view of that size. The layer has twice its resolution, so that edges stay crisp on the display.
    explicit StrokeLayer(PixelSize view);

    void clear();
    /// Places in view pixels (centres at whole numbers).
    void add(std::span<const StrokePiece> pieces, const StrokeLook& look);
    /// Draws what was added since the last call.
    void flush();
    const GlTexture& picture() const { return picture_.color(); }

  private:
    /// Pieces that are drawn with one call.
    struct Batch {
        float radius_px;  // of the layer
        bool erases;
        std::vector<QuadInstance> pieces;
    };

    GlProgram program_;
    GlFramebuffer picture_;
    InstancedQuads quads_;
    std::vector<Batch> waiting_;
};

}  // namespace touchstone
