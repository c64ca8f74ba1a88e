#include "pipeline/fingertip_detection.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>

namespace touchstone {

namespace {

/// Whether the centre of `tip` lies on the shaft behind `other`.
bool is_on_shaft(const FingertipCandidate& tip, const FingertipCandidate& other,
                 const FingertipDetectionConfig& config) {
    const Eigen::Vector3f offset = tip.shape.center_m - other.shape.center_m;
    const float along = offset.dot(other.shape.axis);
    return along > 0.0f && along < config.low_end.radius_m &&
           (offset - along * other.shape.axis).norm() < config.same_tip_m;
}

/// Adds a tip unless its finger is there already; of two on one finger the outer one stays.
void add_distinct(std::vector<FingertipCandidate>& tips, const FingertipCandidate& tip,
                  const FingertipDetectionConfig& config) {
    for (FingertipCandidate& other : tips) {
        const bool same = (other.shape.center_m - tip.shape.center_m).norm() < config.same_tip_m;
        const bool behind = is_on_shaft(tip, other, config), before = is_on_shaft(other, tip, config);
        if (!same && !behind && !before) continue;
        if (same ? tip.points > other.points : before) other = tip;
        return;
    }
    tips.push_back(tip);
}

/// Regions that overlap become one, so that a hand is looked at once.
std::vector<PixelRegion> merged(std::span<const PixelRegion> regions) {
    std::vector<PixelRegion> result;
    for (PixelRegion region : regions) {
        if (region.empty()) continue;
        for (std::size_t i = 0; i < result.size();) {
            if (!overlap(region, result[i])) {
                ++i;
                continue;
            }
            region = hull(region, result[i]);
            result.erase(result.begin() + static_cast<std::ptrdiff_t>(i));
            i = 0;
        }
        result.push_back(region);
    }
    return result;
}

class Search {
  public:
    Search(const TablePicture& picture, std::span<const KnownFinger> known,
           const FingertipDetectionConfig& config)
        : picture_(picture), known_(known), config_(config), flood_(picture, config.low_end) {}

    void look_at_minima(const PixelRegion& region) {
        copy_heights(region);
        const HeightMinima low = find_height_minima(heights_m_, members_, region.width_px(), config_.minima);
        for (const HeightMinimum& minimum : low.minima) {
            const int x = region.x0 + minimum.index % region.width_px();
            const int y = region.y0 + minimum.index / region.width_px();
            const float pixel_m = picture_.live_m[index_of(picture_, x, y)] / picture_.intrinsics.fx_px;
            const int pixels = low.object_pixels[static_cast<std::size_t>(minimum.object)];
            if (static_cast<float>(pixels) * pixel_m * pixel_m >= config_.hand_area_m2) look_at(x, y);
        }
    }

    /// A followed finger without a minimum of its own: from the lowest foreground near its expected place.
    void look_where_expected() {
        for (const KnownFinger& finger : known_) {
            const bool found = std::ranges::any_of(tips_, [&](const FingertipCandidate& tip) {
                return (tip.shape.center_m - finger.shape.center_m).norm() <
                       config_.measurement.known_reach_m;
            });
            if (found || !(finger.shape.center_m.z() > 0.05f)) continue;
            const Eigen::Vector2f middle = project(picture_.intrinsics, finger.shape.center_m);
            const auto [x, y] = lowest_near(middle);
            if (x >= 0) look_at(x, y);
        }
    }

    void add(std::span<const FingertipCandidate> tips) {
        for (const FingertipCandidate& tip : tips) add_distinct(tips_, tip, config_);
    }

    const std::vector<FingertipCandidate>& tips() const { return tips_; }

  private:
    void copy_heights(const PixelRegion& region) {
        const auto width = static_cast<std::size_t>(region.width_px());
        heights_m_.resize(width * static_cast<std::size_t>(region.height_px()));
        members_.resize(heights_m_.size());
        std::size_t to = 0;
        for (int y = region.y0; y < region.y1; ++y) {
            for (int x = region.x0; x < region.x1; ++x, ++to) {
                const std::size_t from = index_of(picture_, x, y);
                members_[to] = is_foreground(picture_, from);
                heights_m_[to] = picture_.height_m[from];
            }
        }
    }

    std::pair<int, int> lowest_near(const Eigen::Vector2f& middle) const {
        std::pair<int, int> lowest{-1, -1};
        float lowest_m = UNKNOWN_HEIGHT_M;
        const int reach = static_cast<int>(config_.seed_reach_px);
        if (!(std::abs(middle.x()) < 1e4f && std::abs(middle.y()) < 1e4f)) return lowest;
        const int cx = static_cast<int>(std::lround(middle.x())),
                  cy = static_cast<int>(std::lround(middle.y()));
        for (int y = cy - reach; y <= cy + reach; ++y) {
            for (int x = cx - reach; x <= cx + reach; ++x) {
                if (!in_picture(picture_, x, y)) continue;
                const std::size_t at = index_of(picture_, x, y);
                if (!is_foreground(picture_, at) || picture_.height_m[at] >= lowest_m) continue;
                lowest_m = picture_.height_m[at];
                lowest = {x, y};
            }
        }
        return lowest;
    }

    /// Whether a pixel is on a finger that was found already.
    bool is_explained(int x, int y) const {
        const Eigen::Vector3f point =
            back_project(picture_.intrinsics, x, y, picture_.live_m[index_of(picture_, x, y)]);
        const FingerFitConfig& fit = config_.measurement.fit;
        return std::ranges::any_of(tips_, [&](const FingertipCandidate& tip) {
            const float along = (point - tip.shape.center_m).dot(tip.shape.axis);
            return along < fit.length_m && distance_m(tip.shape, fit, point) < config_.measurement.side_gap_m;
        });
    }

    void look_at(int x, int y) {
        if (is_explained(x, y)) return;
        const auto tip = measure_fingertip(picture_, flood_.from(x, y), known_, config_.measurement);
        if (tip && tip->height_m <= config_.highest_m) add_distinct(tips_, *tip, config_);
    }

    const TablePicture& picture_;
    std::span<const KnownFinger> known_;
    const FingertipDetectionConfig& config_;
    LowEndFlood flood_;
    std::vector<float> heights_m_;
    std::vector<std::uint8_t> members_;
    std::vector<FingertipCandidate> tips_;
};

}  // namespace

std::vector<FingertipCandidate> detect_fingertips(const TablePicture& picture,
                                                  std::span<const PixelRegion> regions,
                                                  std::span<const KnownFinger> known,
                                                  const FingertipDetectionConfig& config) {
    const std::vector<PixelRegion> apart = merged(regions);
    std::vector<std::vector<FingertipCandidate>> tips(apart.size());
    std::atomic<std::size_t> next = 0;
    const auto look = [&] {
        for (std::size_t i = next++; i < apart.size(); i = next++) {
            Search search(picture, known, config);
            search.look_at_minima(apart[i]);
            tips[i] = search.tips();
        }
    };
    // A second core takes the second hand; of more than two cores the rest is not worth a thread.
    std::future<void> helper;
    if (apart.size() > 1) helper = std::async(std::launch::async, look);
    look();
    if (helper.valid()) helper.get();
    Search search(picture, known, config);
    for (const std::vector<FingertipCandidate>& of_region : tips) search.add(of_region);
    search.look_where_expected();
    return search.tips();
}

}  // namespace touchstone
