#include "pipeline/camera_tracking.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "pipeline/kernel_program.hpp"

namespace touchstone {

namespace {

constexpr std::size_t levels = 3;
/// Of a picture: so high that their noise is independent (a sensor's noise and the filter join a few rows),
/// so many that they tell a covariance.
constexpr std::size_t strips = 30;
constexpr float least_spread_m = 0.01f;
/// A later guess must be: what the data do not constrain stays as in the first one, not as noise would have
/// it.
constexpr double clearly_better = 0.95;
/// Shares of a picture's pixels are told from a part of its rows.
constexpr int judged_row_step = 4;

/// Pixel x of the half-sized picture is at 2 x + 0.5 of the source.
Intrinsics half_sized(const Intrinsics& k) {
    Intrinsics half = k;
    half.fx_px *= 0.5f;
    half.fy_px *= 0.5f;
    half.cx_px = 0.5f * (k.cx_px - 0.5f);
    half.cy_px = 0.5f * (k.cy_px - 0.5f);
    half.width_px = k.width_px / 2;
    half.height_px = k.height_px / 2;
    return half;
}

float sigma_z_m(const SensorNoise& noise, float z_m) {
    const float from_offset = z_m - noise.offset_m;
    return noise.constant_m + noise.quadratic * from_offset * from_offset;
}

/// Middle and spread of what a region of a depth map shows.
ViewExtent measure_extent(const Buffer<float>& depth_m, const Intrinsics& k, const MapShape& shape,
                          const PixelRegion& region) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double squares = 0.0, count = 0.0;
    const auto map = depth_m.map_read();
    for (int y = region.y0; y < std::min(region.y1, k.height_px); ++y) {
        for (int x = region.x0; x < std::min(region.x1, k.width_px); ++x) {
            const float z = map[map_index(shape, x, y)];
            if (z <= 0.0f) continue;
            const Eigen::Vector3d v = back_project(k, x, y, z).cast<double>();
            sum += v;
            squares += v.squaredNorm();
            count += 1.0;
        }
    }
    if (count < 1.0) return {};
    const Eigen::Vector3d mean = sum / count;
    const double spread_m = std::sqrt(std::max(squares / count - mean.squaredNorm(), 0.0));
    return {mean.cast<float>(), std::max(static_cast<float>(spread_m), least_spread_m)};
}

/// Adds what one row of pixels gave.
void add(std::span<const float> row, AlignmentSums& sums) {
    std::size_t at = 0;
    for (int a = 0; a < 6; ++a) {
        for (int b = a; b < 6; ++b) sums.A(a, b) += static_cast<double>(row[at++]);
        sums.b[a] += static_cast<double>(row[ALIGNMENT_B + static_cast<std::size_t>(a)]);
    }
    const std::span<const float> statistics = row.subspan(ALIGNMENT_STATISTICS);
    sums.weight += static_cast<double>(statistics[0]);
    sums.weighted_squares += static_cast<double>(statistics[1]);
    sums.pairs += static_cast<double>(statistics[2]);
    sums.compared += static_cast<double>(statistics[3]);
    sums.measured += static_cast<double>(statistics[4]);
    sums.squares += static_cast<double>(statistics[5]);
    sums.close += static_cast<double>(statistics[6]);
}

/// Lower is better: the root mean square residual plus 2 mm, metres, by the square of the share of live
/// pixels that have a pair: a guess of which half as much fits must be four times as exact.
double misfit(const AlignmentSums& sums) {
    if (sums.pairs < 1.0) return std::numeric_limits<double>::max();
    const double share = sums.pairs / std::max(sums.measured, 1.0);
    return (std::sqrt(sums.squares / sums.pairs) + 0.002) / (share * share);
}

}  // namespace

IntensityMaps::IntensityMaps(const Device& device, const Intrinsics& intrinsics) {
    Intrinsics k = intrinsics;
    for (Buffer<float>& level : levels) {
        level = Buffer<float>(device, map_pixels(make_map_shape(k)));
        k = half_sized(k);
    }
}

CameraTracking::CameraTracking(const Device& device, const CameraTrackingConfig& config,
                               const Intrinsics& intrinsics)
    : config_(config),
      intrinsics_(intrinsics),
      program_(load_kernel_program(device, "listing_1_camera_tracking.cl")),
      conversion_(load_kernel_program(device, "depth_map_conversion.cl")),
      half_sample_(program_.kernel("half_sample")),
      leave_out_(program_.kernel("leave_out")),
      sum_alignment_(program_.kernel("sum_alignment")),
      brightness_(program_.kernel("brightness")),
      half_intensity_(program_.kernel("half_intensity")),
      normal_map_(conversion_.kernel("normal_map")),
      sums_(device, static_cast<std::size_t>(make_map_shape(intrinsics).rows_px) * ALIGNMENT_SUMS),
      rgb_(device, 3 * static_cast<std::size_t>(intrinsics.width_px) *
                       static_cast<std::size_t>(intrinsics.height_px)) {
    Intrinsics k = intrinsics;
    for (Level& level : levels_) {
        level.intrinsics = k;
        level.shape = make_map_shape(k);
        level.depth_m = Buffer<float>(device, map_pixels(level.shape));
        if (&level != &levels_.front() || config.finds_normals)
            level.normals_c = Buffer<float>(device, 3 * map_pixels(level.shape));
        k = half_sized(k);
    }
}

void CameraTracking::prepare(const LiveMaps& live, const LivePixels& pixels) {
    PixelRegion region = pixels.region;
    if (region.empty()) region = {0, 0, live.shape.width_px, live.shape.height_px};
    region = whole_blocks(region, TILE_PX << (levels - 1), live.shape.pitch_px, live.shape.rows_px);
    levels_[0].region = region;
    finest_depth_m_ = &live.filtered_m;
    finest_normals_c_ = &live.normals_c;
    if (pixels.excluded != nullptr) {
        leave_out_.launch(eight_pixels_each(live.shape, region), live.filtered_m, *pixels.excluded,
                          levels_[0].depth_m, live.shape);
        finest_depth_m_ = &levels_[0].depth_m;
    }
    if (config_.finds_normals) {
        find_normals(levels_[0], *finest_depth_m_);
        finest_normals_c_ = &levels_[0].normals_c;
    }
    const Buffer<float>* source = finest_depth_m_;
    for (std::size_t i = 1; i < levels; ++i) {
        Level& level = levels_[i];
        region = {region.x0 / 2, region.y0 / 2, (region.x1 + 1) / 2, (region.y1 + 1) / 2};
        level.region = whole_blocks(region, TILE_PX, level.shape.pitch_px, level.shape.rows_px);
        const LaunchSize size = eight_pixels_each(level.shape, level.region);
        half_sample_.launch(size, *source, level.depth_m, levels_[i - 1].shape, level.shape,
                            config_.half_sample_gap_per_m);
        find_normals(level, level.depth_m);
        source = &level.depth_m;
    }
    const Level& coarsest = levels_.back();
    extent_ = measure_extent(coarsest.depth_m, coarsest.intrinsics, coarsest.shape, coarsest.region);
}

void CameraTracking::find_normals(Level& level, const Buffer<float>& depth_m) {
    normal_map_.launch(eight_pixels_each(level.shape, level.region), depth_m, level.normals_c, level.shape,
                       level.intrinsics, config_.normal_gap_per_m);
}

AlignmentParams CameraTracking::params(int level) const {
    const TrackingLevel& limits = config_.levels[static_cast<std::size_t>(level)];
    AlignmentParams params{};
    params.noise = config_.noise;
    params.centre_p = {extent_.centre_c_m.x(), extent_.centre_c_m.y(), extent_.centre_c_m.z(), 0.0f};
    params.max_distance_m = limits.max_distance_m;
    params.min_normal_cos = std::cos(config_.max_normal_angle_deg * std::numbers::pi_v<float> / 180.0f);
    params.huber_sigmas = config_.huber_sigmas;
    params.cutoff_sigmas = limits.cutoff_sigmas;
    params.reference_sigma_m = sigma_z_m(config_.noise, 1.0f);
    params.intensity_sigma = config_.intensity_sigma;
    return params;
}

void CameraTracking::convert(std::span<const std::uint8_t> rgb, IntensityMaps& maps) {
    rgb_.write(rgb);
    const MapShape& shape = levels_[0].shape;
    brightness_.launch(eight_pixels_each(shape), rgb_, maps.levels[0], shape);
    for (std::size_t i = 1; i < levels; ++i) {
        half_intensity_.launch(eight_pixels_each(levels_[i].shape), maps.levels[i - 1], maps.levels[i],
                               levels_[i - 1].shape, levels_[i].shape);
    }
}

const Buffer<float>& CameraTracking::depth_m(int level) const {
    return level == 0 ? *finest_depth_m_ : levels_[static_cast<std::size_t>(level)].depth_m;
}

LaunchSize CameraTracking::one_row_each(int level, int row_step) const {
    const Level& at = levels_[static_cast<std::size_t>(level)];
    const auto step = static_cast<std::size_t>(row_step),
               first = static_cast<std::size_t>(at.region.y0) / step;
    const auto end = static_cast<std::size_t>(std::min(at.region.y1, at.shape.height_px));
    return {{ceil_div(end, step) - first, 1, 1}, {1, 1, 1}, {first, 0, 0}};
}

AlignmentSums CameraTracking::read_sums(const LaunchSize& size) const {
    AlignmentSums sums;
    const std::size_t rows = size.global[0], first = size.first[0];
    const auto mapped = sums_.map_read((first + rows) * ALIGNMENT_SUMS);
    sums.b_of_strips.assign(strips, Vector6d::Zero());
    for (std::size_t row = 0; row < rows; ++row) {
        const Vector6d before = sums.b;
        add(mapped.values().subspan((first + row) * ALIGNMENT_SUMS, ALIGNMENT_SUMS), sums);
        sums.b_of_strips[row * strips / rows] += sums.b - before;
    }
    sums.A.triangularView<Eigen::StrictlyLower>() = sums.A.transpose();
    return sums;
}

AlignmentSums CameraTracking::sum(const SurfacePrediction& model, const RigidTransform& T_p_c, int level,
                                  const IntensityPair* intensity, int row_step) {
    const auto index = static_cast<std::size_t>(level);
    const Level& at = levels_[index];
    const Buffer<float>& depth = depth_m(level);
    const LaunchSize size = one_row_each(level, row_step);
    sum_alignment_.launch(size, depth, level == 0 ? *finest_normals_c_ : at.normals_c, model.depth_m,
                          model.normals_c, intensity != nullptr ? intensity->live.levels[index] : depth,
                          intensity != nullptr ? intensity->model.levels[index] : depth, sums_, at.shape,
                          at.intrinsics, model.shape, intrinsics_, to_pose(T_p_c), params(level), level,
                          intensity != nullptr ? 1 : 0, row_step, at.region.x0, at.region.x1);
    return read_sums(size);
}

RigidTransform CameraTracking::best_guess(const SurfacePrediction& model,
                                          std::span<const RigidTransform> guesses) {
    if (guesses.size() == 1) return guesses.front();
    const RigidTransform* best = &guesses.front();
    double least = std::numeric_limits<double>::max();
    for (const RigidTransform& guess : guesses) {
        const double value = misfit(sum(model, guess, static_cast<int>(levels) - 1));
        if (value >= clearly_better * least) continue;
        least = value;
        best = &guess;
    }
    return *best;
}

void CameraTracking::refine(const SurfacePrediction& model, const IntensityPair* intensity, int level,
                            TrackingResult& result) {
    const double lever_m = static_cast<double>(extent_.spread_m);
    const TrackingLevel& at = config_.levels[static_cast<std::size_t>(level)];
    for (int i = 0; i < at.iterations; ++i) {
        const AlignmentSums sums = sum(model, result.T_p_c, level, intensity, at.row_step);
        ++result.iterations;
        const TwistSolution solution = solve_twist(sums, lever_m, static_cast<double>(min_eigenvalue_));
        result.evidence = step_evidence(sums, extent_.centre_c_m);
        result.held_directions = solution.held;
        result.eigenvalues = solution.eigenvalues;
        result.T_p_c = orthonormal(twist_about(solution.twist, extent_.centre_c_m) * result.T_p_c);
        const double step_m = solution.twist.head<3>().norm() * lever_m + solution.twist.tail<3>().norm();
        if (step_m < static_cast<double>(at.stop_step_m)) break;
    }
}

TrackingResult CameraTracking::track(const LiveMaps& live, const SurfacePrediction& model,
                                     std::span<const RigidTransform> guesses, const IntensityPair* intensity,
                                     const LivePixels& pixels, int model_frames) {
    TrackingResult result;
    min_eigenvalue_ = std::max(config_.min_eigenvalue,
                               config_.young_min_eigenvalue / static_cast<float>(std::max(model_frames, 1)));
    prepare(live, pixels);
    const RigidTransform start = best_guess(model, guesses);
    result.T_p_c = start;
    for (int level = static_cast<int>(levels) - 1; level >= 0; --level)
        refine(model, intensity, level, result);
    const auto judged = [&](const RigidTransform& T_p_c) {
        return sum(model, T_p_c, 0, nullptr, judged_row_step);
    };
    AlignmentSums sums = judged(result.T_p_c);
    if (judged(start).close > sums.close) {
        // What moves by itself has led the coarse levels astray.
        TrackingResult direct = result;
        direct.T_p_c = start;
        refine(model, intensity, 0, direct);
        const AlignmentSums of_direct = judged(direct.T_p_c);
        if (of_direct.close > sums.close) {
            result = direct;
            sums = of_direct;
        }
    }
    const double pairs = std::max(sums.pairs, 1.0);
    const double reference_m = static_cast<double>(sigma_z_m(config_.noise, 1.0f));
    result.rms_sigmas = static_cast<float>(std::sqrt(sums.weighted_squares / pairs) / reference_m);
    result.rms_mm = static_cast<float>(1000.0 * std::sqrt(sums.squares / pairs));
    result.inlier_share = static_cast<float>(sums.pairs / std::max(sums.compared, 1.0));
    result.close_share = static_cast<float>(sums.close / std::max(sums.compared, 1.0));
    result.model_share = static_cast<float>(sums.compared / std::max(sums.measured, 1.0));
    judge_tracking(config_, result);
    return result;
}

}  // namespace touchstone
