#pragma once

#include <OpenNI.h>

namespace touchstone {

/// While it lives, a colour camera's exposure and white balance stay as they are.
class HeldExposure {
  public:
    /// `color` outlives this.
    explicit HeldExposure(openni::VideoStream& color);
    /// As it was before.
    ~HeldExposure();
    HeldExposure(const HeldExposure&) = delete;
    HeldExposure& operator=(const HeldExposure&) = delete;

    /// The camera lets both be held.
    bool is_held() const { return is_held_; }

  private:
    openni::CameraSettings* settings_;  ///< null where the camera has none
    bool had_auto_exposure_ = false, had_auto_white_balance_ = false, is_held_ = false;
};

}  // namespace touchstone
