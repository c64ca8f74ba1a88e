#include "tests/accuracy/baselines/omni_touch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tests/accuracy/baselines/blobs.hpp"

namespace touchstone::baselines {
namespace {

/// Depth at a point; 0 outside and without a reading.
int depth_at(const DepthPicture& picture, const Eigen::Vector2d& point_px) {
    const int u = static_cast<int>(std::lround(point_px.x())),
              v = static_cast<int>(std::lround(point_px.y()));
    return picture.has(u, v) ? picture.at(u, v) : 0;
}

/// How much farther away it is beyond `end` than at it, on the way from `inner`.
int drop_mm(const DepthPicture& picture, const Eigen::Vector2d& inner, const Eigen::Vector2d& end, int px) {
    const Eigen::Vector2d way = (end - inner).normalized();
    const int here = depth_at(picture, end), beyond = depth_at(picture, end + px * way);
    return here == 0 || beyond == 0 ? 0 : beyond - here;
}

}  // namespace

SliceChain with_tip_last(SliceChain chain, const DepthPicture& picture, int beyond_tip_px) {
    const Eigen::Vector2d middle = chain[chain.size() / 2];
    if (drop_mm(picture, middle, chain.front(), beyond_tip_px) >
        drop_mm(picture, middle, chain.back(), beyond_tip_px))
        std::reverse(chain.begin(), chain.end());
    return chain;
}

std::size_t flood_px(const DepthPicture& picture, const SliceChain& chain, int step_mm, std::size_t most_px) {
    const Eigen::Vector2d middle = chain[chain.size() / 2], tip = chain.back(), way = tip - middle;
    Mask seen(picture.width_px, picture.height_px);
    Blob flood{picture.index(static_cast<int>(std::lround(tip.x())), static_cast<int>(std::lround(tip.y())))};
    if (picture.values[flood.front()] == 0) return 0;
    seen.values[flood.front()] = set_value;
    for (std::size_t next = 0; next < flood.size() && flood.size() < most_px; ++next) {
        for_each_neighbour(picture, flood[next], [&](std::size_t i) {
            const int step = picture.values[i] - picture.values[flood[next]];
            if (seen.values[i] != 0 || picture.values[i] == 0 || std::abs(step) > step_mm) return;
            if ((Eigen::Vector2d(picture.u_of(i), picture.v_of(i)) - middle).dot(way) < 0.0) return;
            seen.values[i] = set_value;
            flood.push_back(i);
        });
    }
    return flood.size();
}

std::vector<PixelTouch> OmniTouch::process(const DepthPicture& picture) {
    std::vector<Eigen::Vector2d> tips_px;
    for (SliceChain& found : find_slice_chains(picture, config_.slices)) {
        const SliceChain chain = with_tip_last(std::move(found), picture, config_.beyond_tip_px);
        const Eigen::Vector2d tip_px = chain.back();
        const bool known = std::any_of(tips_px.begin(), tips_px.end(), [&](const Eigen::Vector2d& other) {
            return (other - tip_px).norm() < config_.same_tip_px;
        });
        if (!known && flood_px(picture, chain, config_.flood_step_mm, config_.flood_px) >= config_.flood_px)
            tips_px.push_back(tip_px);
    }
    return follow(tracker_, tips_px);
}

}  // namespace touchstone::baselines
