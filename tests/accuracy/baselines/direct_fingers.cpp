#include "tests/accuracy/baselines/direct_fingers.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "tests/accuracy/baselines/blobs.hpp"

namespace touchstone::baselines {
namespace {

Mask mask_of(const Raster<Zone>& zones, Zone zone) {
    Mask mask(zones.width_px, zones.height_px);
    std::transform(zones.values.begin(), zones.values.end(), mask.values.begin(),
                   [zone](Zone z) { return z == zone ? set_value : std::uint8_t{0}; });
    return mask;
}

void add_to(Mask& mask, const Blob& blob) {
    for (const std::size_t i : blob) mask.values[i] = set_value;
}

/// The pixels of a blob that have a neighbour in the mask.
Blob border(const Blob& blob, const Mask& mask) {
    Blob found;
    std::copy_if(blob.begin(), blob.end(), std::back_inserter(found), [&](std::size_t i) {
        bool beside = false;
        for_each_neighbour(mask, i, [&](std::size_t n) { beside = beside || mask.values[n] != 0; });
        return beside;
    });
    return found;
}

Mask hands_of(const Raster<Zone>& zones, const FingerConfig& config) {
    Mask arms(zones.width_px, zones.height_px), hands = arms;
    for (const Blob& blob : find_blobs(mask_of(zones, Zone::high), config.least_arm_px)) add_to(arms, blob);
    for (const Blob& blob : find_blobs(mask_of(zones, Zone::mid), config.least_hand_px))
        if (!border(blob, arms).empty()) add_to(hands, blob);
    return hands;
}

/// The pixels of a finger with those of the noise around its tip, nearest first.
Blob with_tip_flood(const Raster<Zone>& zones, const Blob& finger, std::size_t tip, std::size_t most_px) {
    Blob flood{tip};
    for (std::size_t next = 0; next < flood.size() && flood.size() <= most_px; ++next) {
        for_each_neighbour(zones, flood[next], [&](std::size_t i) {
            const bool is_new = std::find(flood.begin(), flood.end(), i) == flood.end();
            if (zones.values[i] == Zone::noise && is_new && flood.size() <= most_px) flood.push_back(i);
        });
    }
    Blob all = finger;
    all.insert(all.end(), flood.begin() + 1, flood.end());
    return all;
}

class FingerFinder {
  public:
    FingerFinder(const Zones& zones, const FingerConfig& config) : zones_(zones), config_(config) {}

    std::optional<Finger> finger_of(const Blob& blob, const Mask& hands) const {
        const Blob root = border(blob, hands);
        if (root.empty()) return std::nullopt;
        const Eigen::Vector2d root_px = centroid_px(root, zones_.zone.width_px);
        const auto distance_px = [&](std::size_t i) { return (pixel(i) - root_px).norm(); };
        const auto nearer = [&](std::size_t a, std::size_t b) { return distance_px(a) < distance_px(b); };
        const std::size_t tip = *std::max_element(blob.begin(), blob.end(), nearer);
        Blob all = with_tip_flood(zones_.zone, blob, tip, config_.most_tip_flood_px);
        const std::size_t count = std::min(config_.height_px, all.size());
        std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count), all.end(),
                          [&](std::size_t a, std::size_t b) { return nearer(b, a); });
        all.resize(count);
        if (distance_px(all.front()) < config_.least_length_px) return std::nullopt;
        const float sum_mm = std::accumulate(all.begin(), all.end(), 0.0F, [&](float sum, std::size_t i) {
            return sum + zones_.height_mm.values[i];
        });
        return Finger{pixel(tip), sum_mm / static_cast<float>(count)};
    }

  private:
    Eigen::Vector2d pixel(std::size_t i) const { return {zones_.zone.u_of(i), zones_.zone.v_of(i)}; }

    const Zones& zones_;
    const FingerConfig& config_;
};

}  // namespace

std::vector<Finger> find_fingers(const Zones& zones, const FingerConfig& config) {
    const Mask hands = hands_of(zones.zone, config);
    const FingerFinder finder(zones, config);
    std::vector<Finger> fingers;
    for (const Blob& blob : find_blobs(mask_of(zones.zone, Zone::low), config.least_finger_px))
        if (const auto finger = finder.finger_of(blob, hands)) fingers.push_back(*finger);
    return fingers;
}

}  // namespace touchstone::baselines
