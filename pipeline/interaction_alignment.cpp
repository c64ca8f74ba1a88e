// What InteractionPipeline does when the camera's pose is not known: at the start with a saved scan, and
// after a knock.
#include "pipeline/interaction_pipeline.hpp"
#include "platform/system/log.hpp"

namespace touchstone {

namespace {

constexpr float changed_inlier_share = 0.85f;  // visitors and what they put down hide less

}  // namespace

CameraVerdict InteractionPipeline::judge_camera(const Foreground& foreground) {
    const StageTimer timer(times_, "camera watch");
    return watch_.judge(live_, background_->prediction(), foreground.mask);
}

void InteractionPipeline::begin_realigning(InteractionFrame& frame) {
    log_warning("the camera was moved: realigning");
    aligning_ = &realignment_;
    aligning_->start(background_->T_g_c());
    foreground_mask_ = &no_foreground_;
    if (foreground_model_) foreground_model_->forget();
    drift_.restore(shift_before_doubt_);
    conversion_.set_column_shift(drift_.shift_per_m());
    frame.touches = touch_.release_all();
    frame.state = InteractionState::realigning;
    frame.note = "The camera was moved: realigning";
}

void InteractionPipeline::align(const DepthView& view, InteractionFrame& frame) {
    const StageTimer timer(times_, "relocalisation");
    const bool at_start = aligning_ == &start_alignment_;
    frame.state = at_start ? InteractionState::starting : InteractionState::realigning;
    frame.note = at_start ? "Comparing the saved scan with the view" : "The camera was moved: realigning";
    const Realignment::Outcome outcome = aligning_->step(live_, view, background_->volume(), &keyframes_);
    if (outcome == Realignment::Outcome::searching) return;
    if (outcome == Realignment::Outcome::given_up) {
        scan_reason_ = at_start ? "The saved scan does not fit the view: scanning anew"
                                : "The camera was moved and finds nothing it knows: scanning anew";
        log_warning("{}", scan_reason_);
        scan_anew();
        return;
    }
    const Displacement step = displacement(background_->T_g_c().inverse() * aligning_->T_g_c());
    const float inlier_share = aligning_->tracking().inlier_share;
    log_info("{}: moved by {:.1f} mm and {:.2f} degrees, {:.0f} % of the view fits",
             at_start ? "the saved scan fits" : "realigned", 1000.0f * step.shift_m, step.turn_deg,
             100.0f * inlier_share);
    if (at_start && inlier_share < changed_inlier_share)
        log_warning(
            "what does not fit is taken for people and things on the table; where the room was changed, "
            "take a new scan (operator's panel)");
    take_pose(aligning_->T_g_c());
}

void InteractionPipeline::take_pose(const RigidTransform& T_g_c) {
    const RigidTransform T_new_old = T_g_c.inverse() * background_->T_g_c();
    background_->move_camera(T_g_c);
    segmentation_.forget();
    objects_.forget();
    segmentation_.learn(live_, background_->prediction());
    watch_.restart();
    if (area_)
        area_ = transformed(T_new_old, *area_);
    else
        fit_area();
    device_->finish();
    scanned_frames_ = config_.scan_frames;
    aligning_ = nullptr;
}

void InteractionPipeline::scan_anew() {
    background_.reset();
    keyframes_ = KeyframeDatabase();
    area_.reset();
    segmentation_.forget();
    objects_.forget();
    watch_.restart();
    scanned_frames_ = 0;
    aligning_ = nullptr;
}

}  // namespace touchstone
