#include "pipeline/moving_parts.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "pipeline/kernel_program.hpp"

namespace touchstone {

namespace {

constexpr int window_levels = 6;          // WINDOW_LEVELS and
constexpr int before_level = 3;           // windows of 8 pixels
constexpr std::size_t window_slack = 64;  // WINDOW_SLACK of moving_parts.cl

std::size_t cells(int per_side) {
    const auto side = static_cast<std::size_t>(per_side);
    return side * side * side;
}

}  // namespace

MovingParts::MovingParts(const Device& device, const MovingPartsConfig& config, const Intrinsics& intrinsics,
                         float side_m)
    : config_(config),
      intrinsics_(intrinsics),
      shape_(make_map_shape(intrinsics)),
      cell_m_(side_m / static_cast<float>(config.cells_per_side)),
      association_(device, config.association, intrinsics),
      components_(device, config.components, shape_),
      program_(load_kernel_program(device, "moving_parts.cl")),
      segmentation_(load_kernel_program(device, "foreground_segmentation.cl")),
      copy_windows_(program_.kernel("copy_windows")),
      double_windows_(program_.kernel("double_windows")),
      mark_taken_(program_.kernel("mark_taken")),
      remember_free_space_(program_.kernel("remember_free_space")),
      mark_moving_(program_.kernel("mark_moving")),
      join_masks_(segmentation_.kernel("join_masks")),
      hold_moving_(program_.kernel("hold_moving")),
      widen_columns_(program_.kernel("widen_columns")),
      keep_supported_seeds_(segmentation_.kernel("keep_supported_seeds")),
      widen_rows_(segmentation_.kernel("widen_rows")),
      codes_(device, map_pixels(shape_)),
      candidates_(device, map_pixels(shape_)),
      members_(device, map_pixels(shape_)),
      none_expected_(device, map_pixels(shape_)),
      parts_(device, map_pixels(shape_)),
      wide_(device, map_pixels(shape_)),
      mask_(device, map_pixels(shape_)),
      young_(device, map_pixels(shape_)),
      untracked_(device, map_pixels(shape_)),
      seen_free_(device, cells(config.cells_per_side)),
      seen_taken_(device, cells(config.cells_per_side)),
      taken_now_(device, cells(config.cells_per_side)),
      held_(device, map_pixels(shape_)),
      last_held_(device, map_pixels(shape_)),
      labels_(device, map_pixels(shape_)),
      no_fallback_m_(device, map_pixels(shape_)),
      last_m_(device, map_pixels(shape_)),
      windows_m_(device, window_levels * (map_pixels(shape_) + window_slack)) {
    for (Before& before : before_) before.nearest_m = Buffer<float>(device, map_pixels(shape_));
    seen_free_.fill(0);
    seen_taken_.fill(0);
    none_expected_.fill(0);
    no_fallback_m_.fill(0.0f);
    forget();
}

void MovingParts::forget() {
    mask_.fill(0);
    untracked_.fill(0);
    watched_frames_ = 0;
    holds_ = false;
    held_.fill(0);
    last_held_.fill(0);
    last_m_.fill(0.0f);
    for (Before& before : before_) before.nearest_m.fill(0.0f);
}

float MovingParts::find(const LiveMaps& live, const SurfacePrediction& model, const RigidTransform& T_p_c,
                        const RigidTransform& T_g_c) {
    const LaunchSize size = eight_pixels_each(shape_);
    association_.associate(live, model, no_fallback_m_, T_p_c, codes_);
    const Before& before = before_[next_before_];
    const RigidTransform T_b_c = before.T_g_b.inverse() * T_g_c;
    const SensorNoise& noise = config_.association.noise;
    mark_moving_.launch(size, codes_, live.filtered_m, seen_free_, seen_taken_, before.nearest_m, candidates_,
                        young_, shape_, intrinsics_, to_pose(T_g_c), to_pose(T_b_c), cell_m_,
                        config_.cells_per_side, config_.enough_frames, young_frames(),
                        config_.into_unknown ? 1 : 0, noise);
    keep_supported_seeds_.launch(size, candidates_, none_expected_, members_, shape_, 1);
    if (turns_fast(T_b_c)) members_.fill(MEMBER_NONE);
    const bool is_still = !holds_ && !has_enough_seeds();
    const float share = is_still ? 0.0f : select_components(components_.find(members_, live.filtered_m));
    if (is_still) {
        held_.fill(0);
        mask_.fill(0);
    } else {
        hold_moving_.launch(size, labels_, members_, codes_, live.filtered_m, last_m_, last_held_, held_,
                            parts_, shape_, intrinsics_, to_pose(T_p_c), config_.hold_frames, noise);
        widen_rows_.launch(size, parts_, wide_, shape_, config_.widen_px);
        widen_columns_.launch(size, wide_, mask_, shape_, config_.widen_px);
        holds_ = std::ranges::any_of(held_.map_read().values(), [](std::uint8_t left) { return left > 0; });
    }
    mark_untracked(live, share);
    const int step = share >= config_.min_watched_share ? 1 : -1;
    watched_frames_ = std::clamp(watched_frames_ + step, 0, config_.most_watched_frames);
    return share;
}

bool MovingParts::has_enough_seeds() const {
    const auto members = members_.map_read();
    return std::ranges::count_if(members.values(), [](std::uint8_t member) {
               return member > MEMBER_GROWTH;
           }) >= config_.min_seeds;
}

int MovingParts::young_frames() const {
    if (watched_frames_ < config_.min_watched_frames) return 0;
    return std::min(config_.young_frames, remembered_frames_ / 2);
}

void MovingParts::mark_untracked(const LiveMaps& live, float moving_share) {
    const LaunchSize size = eight_pixels_each(shape_);
    const bool leave_young =
        young_frames() > 0 && moving_share >= config_.untracked_young_share && enough_is_old(live);
    join_masks_.launch(size, mask_, leave_young ? young_ : mask_, untracked_, shape_);
}

bool MovingParts::enough_is_old(const LiveMaps& live) const {
    const auto young = young_.map_read();
    const auto mask = mask_.map_read();
    const auto depth_m = live.depth_m.map_read();
    std::size_t measured = 0, old = 0;
    for (std::size_t i = 0; i < young.values().size(); ++i) {
        measured += depth_m[i] > 0.0f ? 1 : 0;
        old += depth_m[i] > 0.0f && young[i] == 0 && mask[i] == 0 ? 1 : 0;
    }
    return static_cast<float>(old) >= config_.min_old_share * static_cast<float>(measured);
}

bool MovingParts::turns_fast(const RigidTransform& T_b_c) const {
    const float turn_rad = Eigen::AngleAxisf(T_b_c.linear()).angle();
    return !config_.into_unknown && turn_rad > config_.max_turn_deg * std::numbers::pi_v<float> / 180.0f;
}

float MovingParts::select_components(const std::vector<Component>& found) {
    numbers_.clear();
    int pixels = 0;
    for (const Component& component : found) {
        const auto enough = [&](int seeds) {
            return seeds >= config_.min_seeds &&
                   static_cast<float>(seeds) >= config_.min_seed_share * static_cast<float>(component.pixels);
        };
        numbers_.push_back(enough(component.seeds)                        ? 0
                           : enough(component.seeds + component.unknowns) ? 1
                                                                          : -1);
        pixels += numbers_.back() >= 0 ? component.pixels : 0;
    }
    components_.number(numbers_, labels_, parts_);
    return static_cast<float>(pixels) / static_cast<float>(shape_.width_px * shape_.height_px);
}

void MovingParts::remember(const LiveMaps& live, const RigidTransform& T_g_c, bool fused) {
    const LaunchSize size = eight_pixels_each(shape_);
    copy_windows_.launch(size, live.depth_m, windows_m_, shape_, 0);
    for (int level = 1; level < window_levels; ++level)
        double_windows_.launch(size, windows_m_, shape_, level);
    if (fused) remember_free_space(live, T_g_c);
    Before& before = before_[next_before_];
    copy_windows_.launch(size, windows_m_, before.nearest_m, shape_, before_level);
    before.T_g_b = T_g_c;
    next_before_ = (next_before_ + 1) % before_.size();
    copy_windows_.launch(size, live.filtered_m, last_m_, shape_, 0);
    std::swap(held_, last_held_);
}

void MovingParts::remember_free_space(const LiveMaps& live, const RigidTransform& T_g_c) {
    ++remembered_frames_;
    const auto side = static_cast<std::size_t>(config_.cells_per_side);
    taken_now_.fill(0);
    mark_taken_.launch(eight_pixels_each(shape_), live.depth_m, taken_now_, shape_, intrinsics_,
                       to_pose(T_g_c), cell_m_, config_.cells_per_side);
    remember_free_space_.launch({{side / 8, side, side}, {side / 8, 1, 1}}, live.depth_m, mask_, windows_m_,
                                taken_now_, seen_free_, seen_taken_, cell_m_, config_.cells_per_side,
                                config_.most_frames, config_.association.noise, intrinsics_, shape_,
                                to_pose(T_g_c.inverse()));
}

}  // namespace touchstone
