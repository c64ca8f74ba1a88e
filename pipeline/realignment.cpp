#include "pipeline/realignment.hpp"

#include <algorithm>

namespace touchstone {

namespace {

float valid_share(const DepthView& view) {
    const auto invalid = std::ranges::count(view.depth_mm, std::uint16_t{0});
    return 1.0f -
           static_cast<float>(invalid) / static_cast<float>(std::max<std::size_t>(view.depth_mm.size(), 1));
}

}  // namespace

void Realignment::start(const RigidTransform& T_g_last) {
    T_g_start_ = T_g_c_ = T_g_last;
    seen_ = false;
    still_ = frames_ = 0;
    relocalisation_.restart();
}

bool Realignment::is_too_far(const RigidTransform& T_g_found) const {
    const Displacement moved = displacement(T_g_start_.inverse() * T_g_found);
    return moved.shift_m > config_.max_shift_m || moved.turn_deg > config_.max_turn_deg;
}

Realignment::Outcome Realignment::step(const LiveMaps& live, const DepthView& view, const TsdfVolume& volume,
                                       const KeyframeDatabase* keyframes) {
    if (valid_share(view) < config_.min_valid_share) return Outcome::searching;
    if (++frames_ > config_.most_frames) return Outcome::given_up;
    const auto found = seen_ ? relocalisation_.confirm(live, volume, T_g_c_)
                             : relocalisation_.step(live, view, volume, T_g_c_, keyframes);
    if (!found || is_too_far(*found)) {
        seen_ = false;
        return Outcome::searching;
    }
    const Displacement step = displacement(T_g_c_.inverse() * *found);
    const bool is_still = seen_ && step.shift_m <= config_.still_m && step.turn_deg <= config_.still_deg;
    still_ = is_still ? still_ + 1 : 0;
    seen_ = true;
    T_g_c_ = *found;
    relocalisation_.restart();
    return still_ >= config_.still_frames ? Outcome::found : Outcome::searching;
}

}  // namespace touchstone
