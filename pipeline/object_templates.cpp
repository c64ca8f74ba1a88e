#include "pipeline/object_templates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/bulkiest_place.hpp"

namespace touchstone {

namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr int template_side = 48;
/// Points of a cell that far behind its nearest one are of another surface.
constexpr float layer_m = 0.015f;
constexpr float bin_m = 0.010f;
constexpr int most_bins = 32;

/// Voxel centres within a voxel of the surface, frame o, metres.
std::vector<Eigen::Vector3f> surface_points_o_m(const VolumeSnapshot& object, int most) {
    const VolumeParams params = make_volume_params(object.config);
    const float limit = params.voxel_m / params.max_truncation_m * TSDF_SCALE;
    std::vector<Eigen::Vector3f> points;
    for (std::size_t i = 0; i < object.voxels.size(); ++i) {
        const std::int32_t voxel = object.voxels[i];
        const auto tsdf = static_cast<float>(static_cast<std::int16_t>(voxel & 0xffff));
        if ((voxel >> 16 & 0xff) == 0 || std::abs(tsdf) > limit) continue;
        const int brick = object.bricks[i / BRICK_VOXELS], in = static_cast<int>(i % BRICK_VOXELS);
        const int n = params.bricks_per_side;
        const Eigen::Vector3i corner(brick % n, brick / n % n, brick / n / n);
        const Eigen::Vector3i place = corner * BRICK_VOX + Eigen::Vector3i(in & 7, in >> 3 & 7, in >> 6);
        points.emplace_back((place.cast<float>().array() + 0.5f) * params.voxel_m);
    }
    const std::size_t step = points.size() / static_cast<std::size_t>(most) + 1;
    std::vector<Eigen::Vector3f> some;
    for (std::size_t i = 0; i < points.size(); i += step) some.push_back(points[i]);
    return some;
}

/// Evenly over the sphere: a spiral with the golden angle.
Eigen::Vector3f direction(int i, int count) {
    const float z = 1.0f - (2.0f * static_cast<float>(i) + 1.0f) / static_cast<float>(count);
    const float angle = static_cast<float>(i) * pi * (3.0f - std::sqrt(5.0f));
    const float r = std::sqrt(1.0f - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

/// Turns the direction to the viewer's -z, then about the line of sight.
Eigen::Matrix3f looking_from(const Eigen::Vector3f& to_viewer, float turn_rad) {
    const Eigen::Vector3f towards = -Eigen::Vector3f::UnitZ();
    return (Eigen::AngleAxisf(turn_rad, Eigen::Vector3f::UnitZ()) *
            Eigen::Quaternionf::FromTwoVectors(to_viewer, towards))
        .toRotationMatrix();
}

float turn_between_deg(const Eigen::Matrix3f& a, const Eigen::Matrix3f& b) {
    return std::abs(Eigen::AngleAxisf(Eigen::Matrix3f(a.transpose() * b)).angle()) * 180.0f / pi;
}

}  // namespace

ObjectTemplates::ObjectTemplates(const ObjectTemplatesConfig& config, const VolumeSnapshot& object)
    : config_(config) {
    std::vector<Eigen::Vector3f> points = surface_points_o_m(object, config.most_points);
    if (points.empty()) return;
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& p : points) box.extend(p);
    centre_o_m_ = box.center();
    for (Eigen::Vector3f& p : points) p -= centre_o_m_;
    for (int i = 0; i < config.directions; ++i) {
        for (int j = 0; j < config.turns; ++j) {
            const float turn_rad = 2.0f * pi * static_cast<float>(j) / static_cast<float>(config.turns);
            templates_.push_back(render(looking_from(direction(i, config.directions), turn_rad), points));
        }
    }
}

ObjectTemplates::Template ObjectTemplates::render(const Eigen::Matrix3f& R_v_o,
                                                  std::span<const Eigen::Vector3f> points_m) const {
    constexpr auto cells = static_cast<std::size_t>(template_side * template_side);
    std::vector<float> nearest(cells, std::numeric_limits<float>::max()), sum(cells, 0.0f),
        count(cells, 0.0f);
    const auto cell_of = [&](const Eigen::Vector3f& p) -> std::size_t {
        const int x = static_cast<int>(std::floor(p.x() / config_.cell_m)) + template_side / 2;
        const int y = static_cast<int>(std::floor(p.y() / config_.cell_m)) + template_side / 2;
        const bool inside = x >= 0 && y >= 0 && x < template_side && y < template_side;
        return inside ? static_cast<std::size_t>(y * template_side + x) : cells;
    };
    for (const int pass : {0, 1}) {
        for (const Eigen::Vector3f& point : points_m) {
            const Eigen::Vector3f p = R_v_o * point;
            const std::size_t at = cell_of(p);
            if (at == cells) continue;
            if (pass == 0) nearest[at] = std::min(nearest[at], p.z());
            if (pass == 0 || p.z() > nearest[at] + layer_m) continue;
            sum[at] += p.z();
            count[at] += 1.0f;
        }
    }
    std::vector<std::uint8_t> covered(cells);
    for (std::size_t i = 0; i < cells; ++i) covered[i] = count[i] > 0.0f ? 255 : 0;
    const GridPlace anchor = bulkiest_place(covered, template_side, template_side);
    const auto from = static_cast<std::size_t>(anchor.y * template_side + anchor.x);
    Template result{R_v_o, Eigen::Vector3f::Zero(), {}};
    const float anchor_m = sum[from] / std::max(count[from], 1.0f);
    const auto middle_m = [&](int cell) {
        return (static_cast<float>(cell - template_side / 2) + 0.5f) * config_.cell_m;
    };
    result.anchor_v_m = {middle_m(anchor.x), middle_m(anchor.y), anchor_m};
    for (std::size_t i = 0; i < cells; ++i) {
        if (covered[i] == 0) continue;
        const int x = static_cast<int>(i) % template_side, y = static_cast<int>(i) / template_side;
        result.cells.push_back({x - anchor.x, y - anchor.y, sum[i] / count[i] - anchor_m});
    }
    return result;
}

ObjectTemplates::Fit ObjectTemplates::fit(const Template& at, const ForegroundView& view, int shift_x,
                                          int shift_y) const {
    constexpr int side = ForegroundView::side;
    const int bins = std::min(most_bins, static_cast<int>(2.0f * config_.reach_m / bin_m));
    std::array<int, most_bins> histogram{};
    int against = 0, in_front = 0;
    for (const TemplateCell& cell : at.cells) {
        const int x = cell.x + shift_x + side / 2, y = cell.y + shift_y + side / 2;
        if (x < 0 || y < 0 || x >= side || y >= side) continue;
        const auto i = static_cast<std::size_t>(y * side + x);
        against += view.cells[i] == ForegroundView::Cell::empty;
        if (view.cells[i] != ForegroundView::Cell::seen) continue;
        const float gap = (view.depth_m[i] - cell.depth_m + config_.reach_m) / bin_m;
        if (gap < 0.0f)
            ++in_front;
        else if (gap >= static_cast<float>(bins))
            ++against;
        else
            ++histogram[static_cast<std::size_t>(gap)];
    }
    int best = 0, fits = -1, before_best = 0;
    for (int bin = 0, before = 0; bin + 1 < bins; ++bin) {
        const int two =
            histogram[static_cast<std::size_t>(bin)] + histogram[static_cast<std::size_t>(bin + 1)];
        if (two > fits) fits = two, best = bin, before_best = before;
        before += histogram[static_cast<std::size_t>(bin)];
    }
    int all = 0;
    for (int bin = 0; bin < bins; ++bin) all += histogram[static_cast<std::size_t>(bin)];
    const int behind = all - fits - before_best;
    const int hidden = in_front + before_best;
    const float score = static_cast<float>(fits - against - behind) - 0.25f * static_cast<float>(hidden);
    return {score, (static_cast<float>(best) + 1.0f) * bin_m - config_.reach_m};
}

void ObjectTemplates::match(const ForegroundView& view, std::size_t first, std::size_t end, std::size_t most,
                            std::vector<ObjectCandidate>& best) const {
    for (std::size_t t = first; t < std::min(end, templates_.size()); ++t) {
        const Template& at = templates_[t];
        ObjectCandidate found;
        found.score = config_.min_score_share * static_cast<float>(at.cells.size());
        bool any = false;
        for (int y = -config_.shifts; y <= config_.shifts; ++y) {
            for (int x = -config_.shifts; x <= config_.shifts; ++x) {
                const Fit here = fit(at, view, x, y);
                if (here.score <= found.score) continue;
                any = true;
                found.score = here.score;
                const Eigen::Vector3f place_v_m(static_cast<float>(x) * config_.cell_m,
                                                static_cast<float>(y) * config_.cell_m, here.depth_m);
                RigidTransform T_v_o = RigidTransform::Identity();
                T_v_o.linear() = at.R_v_o;
                T_v_o.translation() = place_v_m - at.anchor_v_m - at.R_v_o * centre_o_m_;
                found.T_c_o = view.T_c_v * T_v_o;
            }
        }
        if (any) keep(found, most, best);
    }
}

void ObjectTemplates::keep(const ObjectCandidate& candidate, std::size_t most,
                           std::vector<ObjectCandidate>& best) const {
    for (ObjectCandidate& other : best) {
        if (turn_between_deg(other.T_c_o.linear(), candidate.T_c_o.linear()) > config_.same_turn_deg)
            continue;
        if (other.score < candidate.score) other = candidate;
        std::ranges::sort(best, std::ranges::greater{}, &ObjectCandidate::score);
        return;
    }
    best.push_back(candidate);
    std::ranges::sort(best, std::ranges::greater{}, &ObjectCandidate::score);
    if (best.size() > most) best.pop_back();
}

}  // namespace touchstone
