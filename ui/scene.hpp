#pragma once

#include <span>
#include <string_view>

#include "pipeline/scene_wish.hpp"
#include "pipeline/touch_event.hpp"
#include "platform/display/gl_texture.hpp"
#include "platform/display/picture.hpp"
#include "ui/canvas.hpp"
#include "ui/view_mapping.hpp"

namespace touchstone {

struct TableFrame;

/// What the table does with touches. Made, called and destroyed on the display's thread, its context current.
class Scene {
  public:
    virtual ~Scene() = default;
    /// One line that tells a passer-by what to do.
    virtual std::string_view invitation() const = 0;
    /// Before the first touch, when the view's size has changed, and when the surface is being scanned anew:
    /// what lay on the old surface is gone.
    virtual void start(PixelSize view) = 0;
    /// A new frame, before its touches.
    virtual void show(const TableFrame&) {}
    /// Events in order; each finger goes down, moves and up.
    virtual void on_touch(const TouchEvent& event) = 0;
    /// All hovering fingers of a new frame.
    virtual void on_hovers(std::span<const HoverEvent> hovers) = 0;
    /// Moves time on; may draw into pictures of its own.
    virtual void update(float dt_s) = 0;
    /// What lies on the surface, under hands: covers the view, row 0 at its top, premultiplied alpha. Null
    /// for nothing.
    virtual const GlTexture* surface_layer() const = 0;
    /// The same over the view, hands too: who draws it looks after what is hidden.
    virtual const GlTexture* overlay_layer() const { return nullptr; }
    /// Its overlay shows another view than the camera's: what marks places on the table would lie wrong.
    virtual bool hides_table() const { return false; }
    /// What it needs from the perception loop from now on.
    virtual SceneWish wish() const { return {}; }
    /// Why what it keeps is not on the disk, for the operator; empty when nothing is wrong.
    virtual std::string_view unsaved() const { return {}; }
    /// What lies over everything.
    virtual void draw(Canvas& canvas, const ViewMapping& view) = 0;
};

}  // namespace touchstone
