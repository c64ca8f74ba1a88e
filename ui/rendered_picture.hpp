#pragma once

#include <memory>
#include <optional>

#include "platform/display/gl_texture.hpp"
#include "ui/table_frame.hpp"

namespace touchstone {

/// What the perception loop rendered last, as a picture to draw.
class RenderedPicture {
  public:
    void show(const TableFrame& frame) {
        if (!frame.rendered || frame.rendered == shown_) return;
        shown_ = frame.rendered;
        const PixelSize size{shown_->picture.width_px, shown_->picture.height_px};
        if (!texture_ || texture_->size_px() != size) texture_.emplace(size);
        texture_->upload(shown_->picture.rgba);
    }
    void forget() {
        texture_.reset();
        shown_ = nullptr;
    }
    const RenderedView* view() const { return shown_.get(); }
    const GlTexture* texture() const { return texture_ ? &*texture_ : nullptr; }

  private:
    std::optional<GlTexture> texture_;
    std::shared_ptr<const RenderedView> shown_;
};

}  // namespace touchstone
