#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "platform/display/display.hpp"
#include "platform/system/projected_picture.hpp"

namespace touchstone {

/// A display whose pictures light a simulated table: what is presented goes to shared memory, too, where the
/// simulator looks for it.
class SimulatedProjector : public Display {
  public:
    /// Takes the size that `display` has now for the largest. Throws Error{io_error} as
    /// ProjectedPictureWriter.
    SimulatedProjector(std::unique_ptr<Display> display, const std::string& name);

    PixelSize size_px() const override { return display_->size_px(); }
    void begin_frame() override { display_->begin_frame(); }
    void present() override;
    Picture read_pixels() override { return display_->read_pixels(); }
    bool should_close() override { return display_->should_close(); }
    std::optional<char> take_key() override { return display_->take_key(); }
    bool is_lost() const override { return display_->is_lost(); }

    /// What a person is to touch, pixels with centres at whole numbers; told with the next picture.
    void set_aim(std::optional<std::array<float, 2>> aim_px) { aim_px_ = aim_px; }

  private:
    std::unique_ptr<Display> display_;
    ProjectedPictureWriter writer_;
    std::optional<std::array<float, 2>> aim_px_;
};

}  // namespace touchstone
