#include "platform/camera/held_exposure.hpp"

namespace touchstone {

HeldExposure::HeldExposure(openni::VideoStream& color) : settings_(color.getCameraSettings()) {
    if (settings_ == nullptr || !settings_->isValid()) {
        settings_ = nullptr;
        return;
    }
    had_auto_exposure_ = settings_->getAutoExposureEnabled();
    had_auto_white_balance_ = settings_->getAutoWhiteBalanceEnabled();
    const bool exposure = settings_->setAutoExposureEnabled(false) == openni::STATUS_OK;
    const bool balance = settings_->setAutoWhiteBalanceEnabled(false) == openni::STATUS_OK;
    is_held_ = exposure && balance;
}

HeldExposure::~HeldExposure() {
    if (settings_ == nullptr) return;
    if (had_auto_exposure_) settings_->setAutoExposureEnabled(true);
    if (had_auto_white_balance_) settings_->setAutoWhiteBalanceEnabled(true);
}

}  // namespace touchstone
