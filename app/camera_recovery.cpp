#include "app/camera_recovery.hpp"

#include <algorithm>

namespace touchstone {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds first_frame{3000}, longest_pause{10'000};

/// From the n-th remedy to the next.
milliseconds pause_after(int attempts) {
    return std::min(longest_pause, milliseconds(1000) * (1 << std::min(attempts - 1, 4)));
}

}  // namespace

void CameraRecovery::opened(Time now, milliseconds silence) {
    silence_ = silence;
    due_ = std::max(due_, now + first_frame);
}

void CameraRecovery::healthy(Time now) {
    attempts_ = 0;
    losses_ = 0;
    due_ = now + silence_;
}

void CameraRecovery::lost(Time now) {
    ++losses_;
    open_at_ = now + pause_after(losses_) / 4;
}

Remedy CameraRecovery::due(Time now) {
    if (now < due_) return Remedy::none;
    ++attempts_;
    due_ = now + pause_after(attempts_);
    if (attempts_ == 1) return Remedy::restart_stream;
    return attempts_ == 2 ? Remedy::reopen : Remedy::reset_and_reopen;
}

}  // namespace touchstone
