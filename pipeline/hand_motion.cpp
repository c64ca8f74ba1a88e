#include "pipeline/hand_motion.hpp"

#include <algorithm>

namespace touchstone {

namespace {

constexpr float least_share_of_span = 0.6f;  // jitter over less is too fast

Eigen::Vector3f pad_c_m(const Fingertip& tip) { return tip.surface_c_m + tip.height_m * tip.normal_c; }

}  // namespace

void HandMotion::see(std::span<const Fingertip> tips, const RigidTransform& T_g_c,
                     std::uint64_t timestamp_us) {
    for (const Fingertip& tip : tips) {
        Hand& hand = hands_[tip.id];
        hand.seen_us = timestamp_us;
        std::erase_if(hand.samples, [&](const Sample& sample) {
            return sample.timestamp_us + config_.span_us < timestamp_us ||
                   sample.timestamp_us >= timestamp_us;
        });
        hand.samples.push_back({T_g_c * pad_c_m(tip), timestamp_us});
        const Sample& oldest = hand.samples.front();
        const auto passed_us = static_cast<float>(timestamp_us - oldest.timestamp_us);
        hand.velocity.setZero();
        if (passed_us < least_share_of_span * static_cast<float>(config_.span_us)) continue;
        const Eigen::Vector3f velocity =
            (hand.samples.back().place_g_m - oldest.place_g_m) / (1e-6f * passed_us);
        const float speed = velocity.norm();
        if (speed >= config_.least_speed)
            hand.velocity = velocity * std::min(1.0f, config_.most_speed / speed);
    }
    std::erase_if(hands_, [&](const auto& each) { return each.second.seen_us != timestamp_us; });
}

Eigen::Vector3f HandMotion::velocity_at(const Eigen::Vector3f& place_g_m) const {
    Eigen::Vector3f velocity(0.0f, 0.0f, 0.0f);
    float nearest_m = config_.reach_m;
    for (const auto& [id, hand] : hands_) {
        const float distance_m = (hand.samples.back().place_g_m - place_g_m).norm();
        if (distance_m >= nearest_m) continue;
        nearest_m = distance_m;
        velocity = hand.velocity;
    }
    return velocity;
}

}  // namespace touchstone
