#include "tests/accuracy/baselines/direct_depth.hpp"

namespace touchstone::baselines {

std::vector<PixelTouch> DirectDepth::process(const DepthPicture& picture) {
    background_.add(picture);
    const Zones zones = find_zones(background_.get(), picture, config_.zones);
    const std::vector<Finger> fingers = find_fingers(zones, config_.fingers);
    std::vector<Eigen::Vector2d> tips_px;
    for (const Finger& finger : fingers) tips_px.push_back(finger.tip_px);
    const std::vector<int> ids = tracker_.follow(tips_px);
    std::erase_if(states_, [&](const auto& state) { return !tracker_.knows(state.first); });
    std::vector<PixelTouch> down;
    for (std::size_t i = 0; i < ids.size(); ++i)
        if (touches(ids[i], fingers[i].height_mm)) down.push_back({ids[i], tips_px[i]});
    return down;
}

bool DirectDepth::touches(int id, float height_mm) {
    State& state = states_.try_emplace(id, State{height_mm, false}).first->second;
    state.height_mm += config_.newest_share * (height_mm - state.height_mm);
    if (state.height_mm < config_.touch_below_mm) state.touches = true;
    if (state.height_mm > config_.release_above_mm) state.touches = false;
    return state.touches;
}

}  // namespace touchstone::baselines
