#include "platform/display/headless_display.hpp"

#include "platform/display/egl_context.hpp"
#include "platform/display/gl_framebuffer.hpp"

namespace touchstone {

namespace {

class HeadlessDisplay : public Display {
  public:
    explicit HeadlessDisplay(PixelSize size) : screen_(size) {}

    PixelSize size_px() const override { return screen_.size_px(); }
    void begin_frame() override { screen_.bind(); }
    void present() override { glFlush(); }
    Picture read_pixels() override { return screen_.read(); }
    bool should_close() override { return false; }
    bool is_lost() const override { return context_.was_reset(); }

  private:
    EglContext context_;
    GlFramebuffer screen_;
};

}  // namespace

std::unique_ptr<Display> make_headless_display(PixelSize size) {
    return std::make_unique<HeadlessDisplay>(size);
}

}  // namespace touchstone
