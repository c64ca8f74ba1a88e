#pragma once

#include <memory>
#include <optional>

#include "platform/display/gl_texture.hpp"
#include "ui/table_frame.hpp"

namespace touchstone {

/// A picture that a scene wishes for and the perception loop renders: what is wished for, and what came last.
class RenderedPicture {
  public:
    /// Another picture is wished for. It moves: more changes may follow, and half quality will do until none
    /// came for a while.
    void change() {
        ++version_;
        since_change_s_ = 0.f;
    }
    void pass_time(float dt_s) { since_change_s_ += dt_s; }
    /// The camera's view, shaded; the scene says what else.
    ViewWish wish() const {
        ViewWish wish;
        wish.version = version_;
        wish.moving = since_change_s_ < rest_s;
        return wish;
    }

    /// Takes in what came.
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
    static constexpr float rest_s = 0.15f;

    int version_ = 0;
    float since_change_s_ = 0.f;
    std::optional<GlTexture> texture_;
    std::shared_ptr<const RenderedView> shown_;
};

}  // namespace touchstone
