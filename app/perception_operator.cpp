// What the perception loop does for the operator.
#include <utility>

#include "app/perception.hpp"
#include "platform/system/log.hpp"

namespace touchstone {

void Perception::take(TableWish wish) {
    wish_ = std::move(wish.scene);
    const OperatorWish asked = desk_.take(wish.operating);
    if (asked.rescans > 0) scan_anew();
    if (asked.recalibrations > 0) calibrate_touches();
    if (asked.recordings > 0) record_soon();
    if (asked.unsaved.empty())
        unsaved_.saved("painting");
    else
        note_unsaved("painting", asked.unsaved);
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
    pipeline_.reset();
    ignores_saved_scan_ = true;
}

void Perception::calibrate_touches() {
    log_info("the operator asks for the crosses");
    bias_ = {};
    if (pipeline_) pipeline_->set_touch_bias(bias_);
    crosses_.emplace(CrossStepConfig{});
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
    view->can_record = fault_reports_ && !desk_.records();
    if (!fault_reports_) view->recording = "To record, name a folder: [health] fault_dir";
    return view;
}

}  // namespace touchstone
