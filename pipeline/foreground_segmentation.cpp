#include "pipeline/foreground_segmentation.hpp"

#include <algorithm>

#include "pipeline/kernel_program.hpp"

namespace touchstone {

namespace {

CandidateParams make_candidate_params(const ForegroundSegmentationConfig& config) {
    const AssociationParams association = make_association_params(config.association);
    return {association.noise, association.quantisation_per_m, association.sigmas_high,
            config.edge_jump_per_m, config.unknown_depth_m};
}

LaunchSize half_tile_each(const MapShape& shape) {
    return {
        {static_cast<std::size_t>(shape.pitch_px / 8), static_cast<std::size_t>(shape.rows_px / TILE_PX), 1}};
}

bool are_near(const PixelBox& a, const PixelBox& b, int gap_px) {
    return a.min_x_px - gap_px <= b.max_x_px && b.min_x_px - gap_px <= a.max_x_px &&
           a.min_y_px - gap_px <= b.max_y_px && b.min_y_px - gap_px <= a.max_y_px;
}

}  // namespace

Foreground::Foreground(const Device& device, const MapShape& map_shape)
    : shape(map_shape),
      rejection(device, map_pixels(map_shape)),
      mask(device, map_pixels(map_shape)),
      background_mask(device, map_pixels(map_shape)),
      labels(device, map_pixels(map_shape)) {
    mask.fill(0);
    background_mask.fill(0);
}

ForegroundSegmentation::ForegroundSegmentation(const Device& device,
                                               const ForegroundSegmentationConfig& config,
                                               const Intrinsics& intrinsics)
    : config_(config),
      intrinsics_(intrinsics),
      params_(make_candidate_params(config)),
      association_(device, config.association, intrinsics),
      components_(device, config.components, make_map_shape(intrinsics)),
      program_(load_kernel_program(device, "foreground_segmentation.cl")),
      mark_candidates_(program_.kernel("mark_candidates")),
      keep_supported_seeds_(program_.kernel("keep_supported_seeds")),
      widen_rows_(program_.kernel("widen_rows")),
      mask_background_(program_.kernel("mask_background")),
      foreground_(device, make_map_shape(intrinsics)),
      candidates_(device, map_pixels(foreground_.shape)),
      members_(device, map_pixels(foreground_.shape)),
      doubted_(device, map_pixels(foreground_.shape)),
      wide_(device, map_pixels(foreground_.shape)),
      held_(device, map_pixels(foreground_.shape)),
      fallback_m_(device, map_pixels(foreground_.shape)) {
    forget();
}

void ForegroundSegmentation::forget() {
    wide_.fill(0);
    held_.fill(0);
    fallback_m_.fill(0.0f);
}

void ForegroundSegmentation::learn(const LiveMaps& live, const SurfacePrediction& background) {
    wide_.fill(0);
    held_.fill(0);
    launch_background_mask(live, background);
}

const Foreground& ForegroundSegmentation::segment(const LiveMaps& live, const SurfacePrediction& background) {
    association_.associate(live, background, fallback_m_, RigidTransform::Identity(), foreground_.rejection);
    mark_candidates(live, background);
    select_components(components_.find(members_, live.filtered_m));
    return foreground_;
}

void ForegroundSegmentation::mark_candidates(const LiveMaps& live, const SurfacePrediction& background) {
    const LaunchSize size = eight_pixels_each(foreground_.shape);
    mark_candidates_.launch(size, foreground_.rejection, live.filtered_m, background.depth_m, fallback_m_,
                            candidates_, foreground_.shape, params_);
    keep_supported_seeds_.launch(size, candidates_, held_, members_, foreground_.shape,
                                 config_.hold_frames + 2 - config_.expect_frames);
}

void ForegroundSegmentation::select_components(const std::vector<Component>& found) {
    verdicts_.clear();
    for (const Component& component : found) verdicts_.push_back(judge(component));
    believe_neighbours(found);
    any_doubted_ = std::ranges::find(verdicts_, Verdict::doubted) != verdicts_.end();
    if (any_doubted_) number_components(found, Verdict::doubted, doubted_);
    number_components(found, Verdict::taken, foreground_.mask);
}

ForegroundSegmentation::Verdict ForegroundSegmentation::judge(const Component& component) const {
    if (!is_foreground(component)) return Verdict::dropped;
    const float sure_m2 = config_.sure_areas * min_area_m2(component.mean_depth_m);
    const bool sure = component.expected > 0 || area_m2(component, component.pixels) >= sure_m2;
    return sure ? Verdict::taken : Verdict::doubted;
}

void ForegroundSegmentation::believe_neighbours(const std::vector<Component>& found) {
    const std::vector<Verdict> alone = verdicts_;
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (alone[i] != Verdict::doubted) continue;
        for (std::size_t j = 0; j < found.size(); ++j) {
            if (alone[j] == Verdict::taken && are_near(found[i].box, found[j].box, config_.widen_px))
                verdicts_[i] = Verdict::taken;
        }
    }
}

void ForegroundSegmentation::number_components(const std::vector<Component>& found, Verdict least,
                                               Buffer<std::uint8_t>& mask) {
    foreground_.components.clear();
    numbers_.clear();
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (verdicts_[i] < least) {
            numbers_.push_back(-1);
            continue;
        }
        const Component& component = found[i];
        const int label = static_cast<int>(foreground_.components.size());
        foreground_.components.push_back({label, component.pixels, component.box, component.mean_depth_m});
        numbers_.push_back(label);
    }
    components_.number(numbers_, foreground_.labels, mask);
}

bool ForegroundSegmentation::is_foreground(const Component& component) const {
    if (area_m2(component, component.unknowns) >= config_.unknown_area_m2) return true;
    const auto seeds = static_cast<float>(component.seeds);
    return component.pixels >= config_.min_pixels &&
           area_m2(component, component.pixels) >= min_area_m2(component.mean_depth_m) &&
           component.seeds > 0 && seeds >= config_.min_seed_share * static_cast<float>(component.pixels);
}

float ForegroundSegmentation::area_m2(const Component& component, int pixels) const {
    const float z_m = component.mean_depth_m;
    return static_cast<float>(pixels) * z_m * z_m / (intrinsics_.fx_px * intrinsics_.fy_px);
}

float ForegroundSegmentation::min_area_m2(float depth_m) const {
    const SensorNoise& noise = config_.association.noise;
    const auto sigma_z_m = [&](float z_m) {
        return noise.constant_m + noise.quadratic * (z_m - noise.offset_m) * (z_m - noise.offset_m);
    };
    const float more_noise = std::max(1.0f, sigma_z_m(depth_m) / sigma_z_m(1.0f));
    return config_.min_area_m2 * more_noise * more_noise;
}

void ForegroundSegmentation::mask_background(const LiveMaps& live, const SurfacePrediction& background) {
    // What is doubted is kept from the background, and is expected in the next frame.
    widen_rows_.launch(eight_pixels_each(foreground_.shape), any_doubted_ ? doubted_ : foreground_.mask,
                       wide_, foreground_.shape, config_.widen_px);
    launch_background_mask(live, background);
}

void ForegroundSegmentation::launch_background_mask(const LiveMaps& live,
                                                    const SurfacePrediction& background) {
    mask_background_.launch(half_tile_each(foreground_.shape), wide_, live.filtered_m, background.depth_m,
                            held_, foreground_.background_mask, fallback_m_, foreground_.shape,
                            config_.widen_px, config_.hold_frames);
}

}  // namespace touchstone
