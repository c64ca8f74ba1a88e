// What the perception loop does for the operator.
#include <utility>

#include "app/perception.hpp"
#include "platform/system/log.hpp"

namespace touchstone {

void Perception::take(TableWish wish) {
    wish_ = std::move(wish.scene);
    projector_.see(wish.projecting);
    const OperatorWish asked = desk_.take(wish.operating);
    if (asked.rescans > 0) scan_anew();
    if (asked.recalibrations > 0) calibrate_touches();
    if (asked.recordings > 0) record_soon();
    if (asked.projector_calibrations > 0) calibrate_projector();
    if (asked.area_lists > 0) change_areas(asked.areas);
    take_unsaved("painting", asked.unsaved);
}

void Perception::note_fault(const std::string& word, const std::string& reason) {
    health_.fault(word);
    desk_.note_fault(word, reason);
}

void Perception::scan_anew() {
    if (!pipeline_) return;
    follow();
    log_info("the operator asks for a new scan");
    release_touches();
    projector_.give_up("a new scan was asked for");
    pipeline_.reset();
    ignores_saved_scan_ = true;
}

void Perception::calibrate_touches() {
    log_info("the operator asks for the crosses");
    bias_ = {};
    if (pipeline_) pipeline_->set_touch_bias(bias_);
    crosses_.emplace(CrossStepConfig{});
}

void Perception::calibrate_projector() {
    if (!camera_ || !pipeline_) return;
    projector_.calibrate(camera_->can_see_color());
    if (projector_.calibrates()) release_touches();
}

void Perception::watch_projector() {
    try {
        camera_->watch_color(projector_.wants_color());
        if (projector_.wants_held_exposure())
            camera_->hold_exposure();
        else
            camera_->release_exposure();
    } catch (const Error& error) {
        projector_.give_up(error.what());
    }
}

void Perception::follow_projector(const InteractionFrame& result, const DepthFrame& frame,
                                  TableFrame& shown) {
    const bool calibrated = projector_.calibrates();
    projector_.follow({result, *pipeline_, frame}, camera_->can_see_color());
    if (calibrated) {
        shown.touches.clear();
        shown.hovers.clear();
    }
    // A finger that still rests on the last cross touches nothing.
    if (calibrated && !projector_.calibrates()) release_touches();
    health_.projector_off(projector_.off_mm());
    take_unsaved("projector's calibration", projector_.unsaved());
    shown.projector = projector_.model();
    shown.surface = projector_.surface();
    shown.thrown = projector_.thrown();
    if (shown.note.empty()) shown.note = projector_.note();
}

/// Fingers that touch now belonged to the old ones.
void Perception::change_areas(std::span<const AreaDraft> drafts) {
    if (!pipeline_ || !pipeline_->area()) return;
    release_touches();
    if (areas_.change(drafts, *pipeline_->area())) outputs_.set_areas(areas_.areas());
}

void Perception::record_soon() {
    if (!fault_reports_ || desk_.records()) return;
    log_info("the operator records ten seconds");
    desk_.begin_recording(std::chrono::steady_clock::now(), options_.config.fault_reports.dir);
}

/// The reports' ring holds just the ten seconds that were asked for.
void Perception::end_recording_when_due() {
    if (desk_.ends_recording(std::chrono::steady_clock::now())) fault_reports_->report("operator");
}

std::shared_ptr<const OperatorView> Perception::operator_view() const {
    if (!desk_.is_open()) return nullptr;
    auto view = std::make_shared<OperatorView>(desk_.view(std::chrono::steady_clock::now()));
    view->device = device_.name();
    view->camera = camera_ ? camera_->name() : "No camera";
    if (camera_) view->camera_rate_hz = static_cast<float>(camera_->rate_hz());
    if (pipeline_) view->stages = pipeline_->stage_times().summary();
    for (const StageSummary& stage : scene_times_.summary()) view->stages.push_back(stage);
    view->can_calibrate_projector = projector_.can_calibrate();
    view->projector = projector_.words();
    view->can_change_areas = areas_.can_change();
    view->areas = areas_.words();
    view->can_record = fault_reports_ && !desk_.records();
    if (!fault_reports_) view->recording = "To record, name a folder: [health] fault_dir";
    return view;
}

}  // namespace touchstone
