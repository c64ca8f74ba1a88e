#include "pipeline/column_drift.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "pipeline/kernel_program.hpp"

namespace touchstone {

namespace {

/// The histogram reaches this many disparity steps to either side.
constexpr float range_steps = 4.0f;
constexpr int half_window_px = 2;

float bin_per_m(const ColumnDriftConfig& config) {
    return 2.0f * range_steps * config.disparity_step_per_m / DRIFT_BINS;
}

ResidualBins operator+(ResidualBins a, const ResidualBins& b) {
    for (std::size_t i = 0; i < DRIFT_BINS; ++i) {
        a.counts[i] += b.counts[i];
        a.sums_per_m[i] += b.sums_per_m[i];
    }
    return a;
}

float total(const ResidualBins& bins) {
    return std::accumulate(bins.counts.begin(), bins.counts.end(), 0.0f);
}

/// Median over a few columns, at least half of which must have a value. Bands have steps, which stay.
std::optional<float> median_of_columns(std::span<const std::optional<float>> values, std::size_t column) {
    std::array<float, 2 * half_window_px + 1> window{};
    std::size_t count = 0;
    const std::size_t first = column < half_window_px ? 0 : column - half_window_px;
    for (std::size_t i = first; i <= std::min(column + half_window_px, values.size() - 1); ++i) {
        if (values[i]) window[count++] = *values[i];
    }
    if (count <= half_window_px) return std::nullopt;
    const auto middle = window.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(window.begin(), middle, window.begin() + static_cast<std::ptrdiff_t>(count));
    return *middle;
}

}  // namespace

std::optional<float> typical_residual_per_m(const ResidualBins& bins, const ColumnDriftConfig& config) {
    const float samples = total(bins);
    if (samples < config.min_samples) return std::nullopt;
    std::size_t median = 0;
    for (float below = bins.counts[0]; below < 0.5f * samples;) below += bins.counts[++median];
    const auto reach = static_cast<std::size_t>(std::lround(config.disparity_step_per_m / bin_per_m(config)));
    if (median < reach || median + reach >= DRIFT_BINS) return std::nullopt;
    float count = 0.0f, sum_per_m = 0.0f;
    for (std::size_t i = median - reach; i <= median + reach; ++i) {
        count += bins.counts[i];
        sum_per_m += bins.sums_per_m[i];
    }
    return sum_per_m / count;
}

ColumnDrift::ColumnDrift(const Device& device, const ColumnDriftConfig& config, const Intrinsics& intrinsics)
    : config_(config),
      shape_(make_map_shape(intrinsics)),
      program_(load_kernel_program(device, "column_drift.cl")),
      column_residuals_(program_.kernel("column_residuals")),
      counts_(device, static_cast<std::size_t>(DRIFT_ZONES * DRIFT_BINS * shape_.pitch_px)),
      sums_(device, counts_.size()),
      estimates_per_m_(static_cast<std::size_t>(shape_.width_px)),
      shift_per_m_(static_cast<std::size_t>(shape_.width_px), 0.0f) {}

std::span<const float> ColumnDrift::update(const LiveMaps& live, const SurfacePrediction& background,
                                           const Foreground& foreground) {
    const DriftParams params{bin_per_m(config_), next_row_, config_.row_step, 0};
    next_row_ = (next_row_ + 1) % config_.row_step;
    column_residuals_.launch(
        {{static_cast<std::size_t>(shape_.pitch_px / 8), DRIFT_ZONES, 1}, {2, DRIFT_ZONES, 1}}, live.depth_m,
        background.depth_m, foreground.background_mask, counts_, sums_, shape_, params);
    estimate_shifts();
    const float limit = config_.max_shift_steps * config_.disparity_step_per_m;
    for (std::size_t column = 0; column < shift_per_m_.size(); ++column) {
        const std::optional<float> estimate = median_of_columns(estimates_per_m_, column);
        if (!estimate) continue;
        float& shift = shift_per_m_[column];
        shift = (1.0f - config_.leak) * shift + config_.gain * (*estimate - shift);
        shift = std::clamp(shift, -limit, limit);
    }
    return shift_per_m_;
}

void ColumnDrift::restore(std::span<const float> shift_per_m) {
    shift_per_m_.assign(shift_per_m_.size(), 0.0f);
    std::ranges::copy(shift_per_m, shift_per_m_.begin());
}

void ColumnDrift::estimate_shifts() {
    const auto counts = counts_.map_read();
    const auto sums = sums_.map_read();
    for (std::size_t column = 0; column < shift_per_m_.size(); ++column) {
        // The residual is what is left after the shift that the frame was converted with.
        const std::optional<float> residual = column_residual(counts.values(), sums.values(), column);
        estimates_per_m_[column] = residual ? std::optional(shift_per_m_[column] - *residual) : std::nullopt;
    }
}

std::optional<float> ColumnDrift::column_residual(std::span<const float> counts, std::span<const float> sums,
                                                  std::size_t column) const {
    std::array<ResidualBins, DRIFT_ZONES> zones;
    const auto pitch = static_cast<std::size_t>(shape_.pitch_px);
    for (std::size_t zone = 0; zone < DRIFT_ZONES; ++zone) {
        for (std::size_t bin = 0; bin < DRIFT_BINS; ++bin) {
            const std::size_t from = (zone * DRIFT_BINS + bin) * pitch + column;
            zones[zone].counts[bin] = counts[from];
            zones[zone].sums_per_m[bin] = sums[from];
        }
    }
    const ResidualBins all = zones[0] + zones[1] + zones[2] + zones[3];
    const std::optional<float> typical = typical_residual_per_m(all, config_);
    if (!typical) return std::nullopt;
    const float gap_per_m = config_.zone_gap_steps * config_.disparity_step_per_m;
    float dissenting = 0.0f;
    ColumnDriftConfig of_a_zone = config_;
    of_a_zone.min_samples = config_.min_samples / DRIFT_ZONES;
    for (const ResidualBins& zone : zones) {
        const std::optional<float> own = typical_residual_per_m(zone, of_a_zone);
        if (own && std::abs(*own - *typical) > gap_per_m) dissenting += total(zone);
    }
    return dissenting > config_.max_dissent * total(all) ? std::nullopt : typical;
}

}  // namespace touchstone
