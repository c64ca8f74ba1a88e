// What InteractionPipeline does until the surroundings are scanned.
#include <cmath>

#include "pipeline/interaction_pipeline.hpp"
#include "platform/system/log.hpp"

namespace touchstone {

bool InteractionPipeline::place_volume(const DepthView& view) {
    const std::optional<VolumePlacement> placement = touchstone::place_volume(view, config_.background);
    if (!placement) return false;
    background_.emplace(*device_, config_.background, intrinsics_, *placement);
    stillness_.restart();
    return true;
}

void InteractionPipeline::scan(const DepthView& view, InteractionFrame& frame) {
    const StageTimer timer(times_, "background scan");
    stillness_.judge(live_);
    background_->scan(live_);
    segmentation_.learn(live_, background_->prediction());
    device_->finish();
    frame.state = InteractionState::scanning;
    frame.note = scan_reason_;
    if (!waits_for_stillness(frame)) ++scanned_frames_;
    frame.scan_frames_done = scanned_frames_;
    frame.scan_progress = static_cast<float>(scanned_frames_) / static_cast<float>(config_.scan_frames);
    if (scanned_frames_ < config_.scan_frames) return;
    keep_what_is_still();
    const TsdfVolume& volume = background_->volume();
    log_info("scanned: {:.1f} million voxels of {:.1f} mm, {:.0f} MB",
             volume.bricks_in_use() * BRICK_VOXELS * 1e-6, 1000.0f * volume.params().voxel_m,
             static_cast<double>(volume.memory_bytes()) / 1e6);
    keyframes_.add_if_new(make_small_picture(view), background_->T_g_c());
    scan_reason_.clear();
    fit_area();
}

/// The last frame of the scan waits until most of the view has stood still, for a time.
bool InteractionPipeline::waits_for_stillness(InteractionFrame& frame) {
    log_debug("scan: {:.2f} % of the view moves, {:.2f} % is not still yet",
              100.0f * stillness_.moving_share(), 100.0f * stillness_.unknown_share());
    const bool last = scanned_frames_ + 1 >= config_.scan_frames;
    const int longest = stillness_.much_is_unknown()   ? config_.stillness.wait_frames
                        : stillness_.something_moves() ? config_.stillness.mover_wait_frames
                                                       : 0;
    const bool waits =
        last && waited_frames_ < longest && config_.scan_frames > config_.stillness.least_frames;
    if (waits || stillness_.something_moves()) frame.note = "Something moves in the view: step back";
    if (waits && waited_frames_++ == 0) log_info("the scan waits: something moves in the view");
    return waits;
}

/// What was fused before it moved is left out.
void InteractionPipeline::keep_what_is_still() {
    waited_frames_ = 0;
    const ScanStillness::StillView still = stillness_.still_view();
    if (!still.replaces_scan || config_.scan_frames <= config_.stillness.least_frames) return;
    std::vector<std::uint16_t> depth_mm;
    for (int y = 0; y < shape_.height_px; ++y) {
        for (int x = 0; x < shape_.width_px; ++x)
            depth_mm.push_back(
                static_cast<std::uint16_t>(std::lround(1000.0f * still.depth_m[map_index(shape_, x, y)])));
    }
    conversion_.convert({depth_mm, intrinsics_}, live_);
    live_.depth_m.write(still.depth_m);
    background_->scan_anew(live_, still.frames);
    segmentation_.forget();
    segmentation_.learn(live_, background_->prediction());
    device_->finish();
    log_info("the scan leaves out what moved");
}

void InteractionPipeline::fit_area() {
    area_ = config_.fit_area ? fit_interactive_area(background_->prediction(), intrinsics_, config_.area_fit)
                             : std::optional(config_.area);
    if (!area_) area_ = whole_view_area(background_->prediction(), intrinsics_);
}

}  // namespace touchstone
