#include "pipeline/interaction_pipeline.hpp"

namespace touchstone {

namespace {

RealignmentConfig at_start(const InteractionConfig& config) {
    RealignmentConfig realignment = config.realignment;
    realignment.most_frames = config.saved_scan_frames;
    // Another table is easily taken for the saved one from somewhere else.
    realignment.max_shift_m = 0.15f;
    realignment.max_turn_deg = 10.0f;
    realignment.relocalisation.min_inlier_share = 0.7f;
    return realignment;
}

}  // namespace

InteractionConfig with_shared_noise(InteractionConfig config) {
    config.conversion.noise = config.noise;
    config.background.weights.noise = config.noise;
    config.background.color.noise = config.noise;
    config.segmentation.association.noise = config.noise;
    config.segmentation.components.noise = config.noise;
    config.touch.map.noise = config.noise;
    config.touch.tracking.noise = config.noise;
    config.foreground.weights.noise = config.noise;
    config.foreground.tracking.noise = config.noise;
    config.held.noise = config.noise;
    config.watch.noise = config.noise;
    config.background.objects.noise = config.noise;
    config.stillness.noise = config.noise;
    config.realignment.relocalisation.tracking.noise = config.noise;
    return config;
}

InteractionPipeline::InteractionPipeline(const Device& device, const InteractionConfig& config,
                                         const Intrinsics& intrinsics)
    : device_(&device),
      config_(with_shared_noise(config)),
      intrinsics_(intrinsics),
      shape_(make_map_shape(intrinsics)),
      conversion_(device, config_.conversion, intrinsics),
      live_(device, shape_),
      stillness_(device, config_.stillness, intrinsics),
      segmentation_(device, config_.segmentation, intrinsics),
      drift_(device, config_.drift, intrinsics),
      touch_(device, config_.touch, intrinsics),
      objects_(config_.background.objects, intrinsics),
      rendering_(device, config_.rendering, intrinsics),
      no_foreground_(device, map_pixels(shape_)),
      foreground_mask_(&no_foreground_),
      watch_(device, config_.watch, intrinsics),
      realignment_(device, config_.realignment, intrinsics),
      start_alignment_(device, at_start(config_), intrinsics) {
    no_foreground_.fill(0);
    if (reconstructs_foreground(config_.foreground, device))
        foreground_model_.emplace(device, config_.foreground, intrinsics);
}

void InteractionPipeline::use_scan(const SavedScan& scan) {
    background_.emplace(*device_, config_.background, intrinsics_, scan.volume, scan.T_g_c);
    keyframes_ = KeyframeDatabase({}, scan.keyframes);
    aligning_ = &start_alignment_;
    aligning_->start(scan.T_g_c);
}

void InteractionPipeline::follow_object(const VolumeSnapshot& model) {
    held_.reset();
    held_.emplace(*device_, config_.held, intrinsics_, model);
}

SavedScan InteractionPipeline::saved_scan() const {
    const std::span<const Keyframe> keyframes = keyframes_.keyframes();
    return {take_snapshot(background_->volume()),
            intrinsics_,
            background_->T_g_c(),
            {keyframes.begin(), keyframes.end()}};
}

void InteractionPipeline::release_touches() {
    const std::vector<TouchEvent> ups = touch_.release_all();
    released_.insert(released_.end(), ups.begin(), ups.end());
}

InteractionFrame InteractionPipeline::process(const DepthView& view, std::uint64_t timestamp_us) {
    InteractionFrame frame = see(view, timestamp_us);
    follow();
    return frame;
}

InteractionFrame InteractionPipeline::see(const DepthView& view, std::uint64_t timestamp_us) {
    const StageTimer whole(times_, "frame");
    const StageTimer until_touches(times_, "touches out");
    InteractionFrame frame;
    foreground_is_modelled_ = false;
    to_follow_ = nullptr;
    {
        const StageTimer timer(times_, "depth map conversion");
        conversion_.convert_depth(view, live_);
        has_normals_ = false;
    }
    if (!normals_can_wait()) find_normals();
    if (!background_ && !place_volume(view))
        frame.note = "The camera sees nothing between 0.3 and 6 m yet";
    else if (aligning_ != nullptr)
        align(view, frame);
    else if (scanned_frames_ < config_.scan_frames)
        scan(view, frame);
    else
        interact(timestamp_us, frame);
    frame.touches.insert(frame.touches.begin(), released_.begin(), released_.end());
    released_.clear();
    return frame;
}

/// Touches need none.
bool InteractionPipeline::normals_can_wait() const {
    const bool live = background_ && aligning_ == nullptr && scanned_frames_ >= config_.scan_frames;
    return live && !foreground_model_ && !held_;
}

void InteractionPipeline::find_normals() {
    if (has_normals_) return;
    const StageTimer timer(times_, "normal maps");
    conversion_.find_normals(live_);
    has_normals_ = true;
}

void InteractionPipeline::follow(std::span<const std::uint8_t> rgb) {
    if (to_follow_ != nullptr) {
        const StageTimer whole(times_, "frame");
        find_normals();
        follow_sensor(*to_follow_);
        if (pose_is_sure_) {
            const StageTimer timer(times_, "volumetric integration, raycast");
            background_->follow(live_, to_follow_->background_mask, rgb);
            device_->finish();
        }
        to_follow_ = nullptr;
    }
    times_.end_frame();
}

void InteractionPipeline::follow_sensor(const Foreground& foreground) {
    const StageTimer timer(times_, "sensor drift");
    segmentation_.mask_background(live_, background_->prediction());
    const std::span<const float> before = drift_.shift_per_m();
    if (pose_is_sure_) shift_before_doubt_.assign(before.begin(), before.end());
    conversion_.set_column_shift(drift_.update(live_, background_->prediction(), foreground));
}

void InteractionPipeline::interact(std::uint64_t timestamp_us, InteractionFrame& frame) {
    frame.state = InteractionState::live;
    frame.scan_progress = 1.0f;
    frame.scan_frames_done = scanned_frames_;
    const SurfacePrediction& background = background_->prediction();
    const Foreground& foreground = [&]() -> const Foreground& {
        const StageTimer timer(times_, "foreground segmentation");
        return segmentation_.segment(live_, background);
    }();
    const CameraVerdict verdict = judge_camera(foreground);
    if (verdict == CameraVerdict::moved) {
        begin_realigning(frame);
        return;
    }
    foreground_mask_ = &foreground.mask;
    to_follow_ = &foreground;
    pose_is_sure_ = verdict == CameraVerdict::still;
    if (!pose_is_sure_) return;
    detect_touches(foreground, timestamp_us, frame);
    reconstruct_foreground(foreground);
    find_held_object(foreground, frame);
    segment_objects(foreground, timestamp_us, frame);
}

void InteractionPipeline::reconstruct_foreground(const Foreground& foreground) {
    if (!foreground_model_) return;
    const StageTimer timer(times_, "foreground reconstruction");
    foreground_model_->update(live_, foreground);
    foreground_is_modelled_ = true;
}

void InteractionPipeline::find_held_object(const Foreground& foreground, InteractionFrame& frame) {
    if (!held_) return;
    const StageTimer timer(times_, "held object");
    frame.held = held_->process(live_, foreground.mask);
}

void InteractionPipeline::detect_touches(const Foreground& foreground, std::uint64_t timestamp_us,
                                         InteractionFrame& frame) {
    const StageTimer timer(times_, "touch detection");
    std::vector<PixelRegion> regions;
    for (const ForegroundComponent& component : foreground.components) {
        const PixelBox& box = component.box;
        regions.push_back({box.min_x_px, box.min_y_px, box.max_x_px + 1, box.max_y_px + 1});
    }
    TrackedTouches tracked =
        touch_.detect({live_, background_->prediction(), foreground.mask, regions, *area_, timestamp_us});
    frame.touches = std::move(tracked.touches);
    frame.hovers = std::move(tracked.hovers);
}

void InteractionPipeline::segment_objects(const Foreground& foreground, std::uint64_t timestamp_us,
                                          InteractionFrame& frame) {
    const StageTimer timer(times_, "object segmentation");
    frame.objects = objects_.update(live_, foreground, frame.touches, timestamp_us, *background_);
    if (config_.follow_lifted && !frame.objects.lifted.empty()) follow_object(frame.objects.lifted.back());
}

ShadedView InteractionPipeline::view() {
    if (!background_) return {};
    find_normals();
    if (!foreground_is_modelled_)
        return rendering_.render(background_->prediction(), {live_.normals_c, *foreground_mask_});
    return rendering_.render(background_->prediction(),
                             {foreground_model_->surface().normals_c, foreground_model_->source()});
}

std::vector<std::uint8_t> InteractionPipeline::foreground_map() const {
    return without_padding(*foreground_mask_, shape_);
}

std::vector<std::uint8_t> InteractionPipeline::touch_map() const {
    const bool live = foreground_mask_ != &no_foreground_;
    return without_padding(live ? touch_.touch_map().touch : no_foreground_, shape_);
}

}  // namespace touchstone
