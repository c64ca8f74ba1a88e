#include "pipeline/fingertip_detection.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace touchstone {

namespace {

using Eigen::Vector3f;

/// A low end of the foreground with its surroundings.
struct LowEnd {
    Vector3f seed_m;
    std::vector<Vector3f> points_m;  ///< the connected foreground around it
};

bool is_member(const TablePicture& picture, std::size_t at) {
    return picture.mask[at] != 0 && picture.live_m[at] > 0.0f && picture.height_m[at] < UNKNOWN_HEIGHT_M;
}

/// Grows from a pixel over foreground without steps, up to a distance from the pixel's point.
class LocalFlood {
  public:
    LocalFlood(const TablePicture& picture, const FingertipDetectionConfig& config)
        : picture_(picture), config_(config) {}

    LowEnd from(int x, int y) {
        LowEnd end;
        end.seed_m = point(x, y);
        const float half_px = config_.flood_radius_m * picture_.intrinsics.fx_px / end.seed_m.z();
        half_px_ = static_cast<int>(half_px) + 2;
        origin_x_ = x - half_px_, origin_y_ = y - half_px_;
        side_px_ = 2 * half_px_ + 1;
        seen_.assign(static_cast<std::size_t>(side_px_ * side_px_), 0);
        stack_.clear();
        visit(x, y, end);
        while (!stack_.empty()) {
            const auto [from_x, from_y] = stack_.back();
            stack_.pop_back();
            const Vector3f here = point(from_x, from_y);
            // A step of two pixels bridges single lost ones.
            for (const auto& [dx, dy] : steps) try_step(here, from_x + dx, from_y + dy, end);
        }
        return end;
    }

  private:
    static constexpr std::pair<int, int> steps[] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1},
                                                    {-1, 1}, {1, 1}, {-2, 0}, {2, 0}, {0, -2},  {0, 2}};

    Vector3f point(int x, int y) const {
        return back_project(picture_.intrinsics, x, y, picture_.live_m[index_of(picture_, x, y)]);
    }
    void visit(int x, int y, LowEnd& end) {
        seen_[static_cast<std::size_t>((y - origin_y_) * side_px_ + x - origin_x_)] = 1;
        stack_.emplace_back(x, y);
        end.points_m.push_back(point(x, y));
    }
    void try_step(const Vector3f& here, int x, int y, LowEnd& end) {
        if (std::abs(x - origin_x_ - half_px_) > half_px_ || std::abs(y - origin_y_ - half_px_) > half_px_)
            return;
        if (!in_picture(picture_, x, y)) return;
        if (seen_[static_cast<std::size_t>((y - origin_y_) * side_px_ + x - origin_x_)] != 0) return;
        if (!is_member(picture_, index_of(picture_, x, y))) return;
        const Vector3f there = point(x, y);
        if ((there - here).norm() > config_.flood_step_m) return;
        if ((there - end.seed_m).norm() > config_.flood_radius_m) return;
        visit(x, y, end);
    }

    const TablePicture& picture_;
    const FingertipDetectionConfig& config_;
    int origin_x_ = 0, origin_y_ = 0, half_px_ = 0, side_px_ = 0;
    std::vector<char> seen_;
    std::vector<std::pair<int, int>> stack_;
};

FingerShape guess_shape(const LowEnd& end, const RadiusPrior& prior) {
    Vector3f centroid = Vector3f::Zero();
    for (const Vector3f& p : end.points_m) centroid += p;
    centroid /= static_cast<float>(end.points_m.size());
    FingerShape guess;
    guess.radius_m = prior.radius_m;
    const Vector3f along = centroid - end.seed_m;
    guess.axis = along.norm() > 1e-4f ? Vector3f(along.normalized()) : Vector3f(0.0f, 0.0f, -1.0f);
    guess.center_m = end.seed_m + prior.radius_m * (0.6f * guess.axis + 0.4f * end.seed_m.normalized());
    return guess;
}

/// Whether the points around the end are those of a finger: a shaft behind the tip, and room on both sides.
bool looks_like_finger(const LowEnd& end, const FingerFit& fit, const FingertipDetectionConfig& config) {
    int beside = 0, shaft = 0, near = 0;
    for (const Vector3f& p : end.points_m) {
        const float along = (p - fit.shape.center_m).dot(fit.shape.axis);
        if (along > config.fit.length_m) continue;
        ++near;
        const float outside_m = distance_m(fit.shape, config.fit, p);
        beside += outside_m > config.side_gap_m;
        shaft += along > config.least_shaft_m && outside_m < config.side_gap_m;
    }
    const auto share = [&](int part) {
        return static_cast<float>(part) / static_cast<float>(std::max(1, near));
    };
    return share(beside) <= config.most_beside && shaft >= 6 &&
           static_cast<float>(fit.inliers) >= config.least_inliers * static_cast<float>(near) &&
           fit.rms_sigmas <= config.most_rms_sigmas;
}

/// Height that the background around a point seems to have: the sensor's local drift. 0 where too little of
/// it is seen.
float local_drift_m(const TablePicture& picture, const SurfacePoint& foot,
                    const FingertipDetectionConfig& config) {
    const Eigen::Vector2f middle = project(picture.intrinsics, foot.point_c_m);
    const float px_per_m = picture.intrinsics.fx_px / foot.point_c_m.z();
    const int outer = static_cast<int>(config.ring_outer_m * px_per_m);
    const float inner_px = config.ring_inner_m * px_per_m;
    const int cx = static_cast<int>(std::lround(middle.x())), cy = static_cast<int>(std::lround(middle.y()));
    std::vector<float> heights_m;
    for (int dy = -outer; dy <= outer; dy += 2) {
        for (int dx = -outer; dx <= outer; dx += 2) {
            const float r = std::hypot(static_cast<float>(dx), static_cast<float>(dy));
            const int x = cx + dx, y = cy + dy;
            if (r < inner_px || r > static_cast<float>(outer) || !in_picture(picture, x - 3, y - 3) ||
                !in_picture(picture, x + 3, y + 3))
                continue;
            const auto masked = [&](int i, int j) {
                return picture.mask[index_of(picture, x + i, y + j)] != 0;
            };
            if (masked(0, 0) || masked(-3, 0) || masked(3, 0) || masked(0, -3) || masked(0, 3)) continue;
            const float z = picture.live_m[index_of(picture, x, y)];
            const SurfacePoint surface = background_at(picture, x, y);
            if (z <= 0.0f || !surface.known) continue;
            heights_m.push_back(
                surface.normal_c.dot(back_project(picture.intrinsics, x, y, z) - surface.point_c_m));
        }
    }
    if (static_cast<int>(heights_m.size()) < config.ring_least_pixels) return 0.0f;
    const auto half = heights_m.begin() + static_cast<std::ptrdiff_t>(heights_m.size() / 2);
    std::ranges::nth_element(heights_m, half);
    return std::abs(*half) <= config.most_drift_m ? *half : 0.0f;
}

RadiusPrior prior_near(const Vector3f& point_m, std::span<const KnownFinger> known) {
    RadiusPrior prior;
    float nearest_m = 0.025f;
    for (const KnownFinger& finger : known) {
        const float distance = (finger.center_c_m - point_m).norm();
        if (distance >= nearest_m) continue;
        nearest_m = distance;
        prior = finger.radius;
    }
    return prior;
}

std::optional<FingertipCandidate> examine(const TablePicture& picture, const LowEnd& end,
                                          std::span<const KnownFinger> known,
                                          const FingertipDetectionConfig& config) {
    const RadiusPrior prior = prior_near(end.seed_m, known);
    const float sigma_m = sigma_z_m(picture.noise, end.seed_m.z());
    const FingerFit fit = fit_finger(end.points_m, guess_shape(end, prior), prior, sigma_m, config.fit);
    if (!fit.ok || !looks_like_finger(end, fit, config)) return std::nullopt;
    const SurfacePoint foot = foot_point(picture, fit.shape.center_m);
    if (!foot.known) return std::nullopt;
    FingertipCandidate tip;
    tip.shape = fit.shape;
    tip.normal_c = foot.normal_c;
    tip.surface_c_m = foot.point_c_m;
    tip.height_m = foot.normal_c.dot(fit.shape.center_m - foot.point_c_m) - fit.shape.radius_m -
                   local_drift_m(picture, foot, config);
    tip.rms_sigmas = fit.rms_sigmas;
    tip.points = fit.inliers;
    if (tip.height_m > config.highest_m) return std::nullopt;
    return tip;
}

/// Adds a tip unless a better one is there already.
void add_distinct(std::vector<FingertipCandidate>& tips, const FingertipCandidate& tip, float same_tip_m) {
    for (FingertipCandidate& other : tips) {
        if ((other.shape.center_m - tip.shape.center_m).norm() > same_tip_m) continue;
        if (tip.points > other.points) other = tip;
        return;
    }
    tips.push_back(tip);
}

/// Boxes that overlap become one, so that a hand is looked at once.
std::vector<PixelRegion> merged(std::span<const PixelRegion> boxes) {
    std::vector<PixelRegion> result;
    for (PixelRegion box : boxes) {
        if (box.empty()) continue;
        for (std::size_t i = 0; i < result.size();) {
            if (!overlap(box, result[i])) {
                ++i;
                continue;
            }
            box = hull(box, result[i]);
            result.erase(result.begin() + static_cast<std::ptrdiff_t>(i));
            i = 0;
        }
        result.push_back(box);
    }
    return result;
}

void detect_in_box(const TablePicture& picture, const PixelRegion& box, std::span<const KnownFinger> known,
                   const FingertipDetectionConfig& config, std::vector<FingertipCandidate>& tips) {
    const auto width = static_cast<std::size_t>(box.width_px());
    std::vector<float> heights_m(width * static_cast<std::size_t>(box.height_px()));
    std::vector<std::uint8_t> members(heights_m.size());
    for (int y = box.y0; y < box.y1; ++y) {
        for (int x = box.x0; x < box.x1; ++x) {
            const std::size_t from = index_of(picture, x, y);
            const std::size_t to =
                static_cast<std::size_t>(y - box.y0) * width + static_cast<std::size_t>(x - box.x0);
            members[to] = is_member(picture, from);
            heights_m[to] = picture.height_m[from];
        }
    }
    const HeightMinima low = find_height_minima(heights_m, members, box.width_px(), config.minima);
    LocalFlood flood(picture, config);
    for (const HeightMinimum& minimum : low.minima) {
        const int x = box.x0 + minimum.index % box.width_px(), y = box.y0 + minimum.index / box.width_px();
        const float pixel_m = picture.live_m[index_of(picture, x, y)] / picture.intrinsics.fx_px;
        const int pixels = low.object_pixels[static_cast<std::size_t>(minimum.object)];
        if (static_cast<float>(pixels) * pixel_m * pixel_m < config.hand_area_m2) continue;
        const auto tip = examine(picture, flood.from(x, y), known, config);
        if (tip) add_distinct(tips, *tip, config.same_tip_m);
    }
}

}  // namespace

std::vector<FingertipCandidate> detect_fingertips(const TablePicture& picture,
                                                  std::span<const PixelRegion> boxes,
                                                  std::span<const KnownFinger> known,
                                                  const FingertipDetectionConfig& config) {
    std::vector<FingertipCandidate> tips;
    for (const PixelRegion& box : merged(boxes)) detect_in_box(picture, box, known, config, tips);
    return tips;
}

}  // namespace touchstone
