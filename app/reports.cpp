#include "app/reports.hpp"

namespace touchstone {

namespace {

ReportedFinger to_finger(const Fingertip& tip) {
    ReportedFinger finger;
    finger.id = tip.id;
    for (int axis = 0; axis < 3; ++axis) {
        finger.camera_mm[static_cast<std::size_t>(axis)] =
            1000.0 * static_cast<double>(tip.surface_c_m[axis]);
    }
    finger.surface = {tip.area_uv.x(), tip.area_uv.y()};
    finger.height_mm = 1000.0 * static_cast<double>(tip.height_m);
    return finger;
}

ReportedPhase to_phase(TouchPhase phase) {
    switch (phase) {
        case TouchPhase::down:
            return ReportedPhase::down;
        case TouchPhase::move:
            return ReportedPhase::move;
        case TouchPhase::up:
            break;
    }
    return ReportedPhase::up;
}

const char* state_word(HeldObjectState state) {
    switch (state) {
        case HeldObjectState::searching:
            return "searching";
        case HeldObjectState::tracked:
            return "tracked";
        case HeldObjectState::lost:
            break;
    }
    return "lost";
}

ReportedObject to_object(const HeldObjectFrame& held) {
    ReportedObject object{state_word(held.state), held.reason, {}, {}};
    const Eigen::Quaternionf turn(held.T_c_o.linear());
    for (int axis = 0; axis < 3; ++axis) {
        object.camera_mm[static_cast<std::size_t>(axis)] =
            1000.0 * static_cast<double>(held.T_c_o.translation()[axis]);
    }
    for (int part = 0; part < 4; ++part)
        object.quaternion[static_cast<std::size_t>(part)] = static_cast<double>(turn.coeffs()[part]);
    return object;
}

}  // namespace

const char* state_word(InteractionState state) {
    switch (state) {
        case InteractionState::starting:
            return "starting";
        case InteractionState::scanning:
            return "scanning";
        case InteractionState::realigning:
            return "realigning";
        case InteractionState::live:
            break;
    }
    return "live";
}

TouchReport make_report(const InteractionFrame& frame, int index, std::uint64_t time_us) {
    TouchReport report{index, time_us, state_word(frame.state), {}, {}};
    for (const TouchEvent& touch : frame.touches) {
        report.touches.push_back(to_finger(touch.tip));
        report.touches.back().phase = to_phase(touch.phase);
    }
    for (const HoverEvent& hover : frame.hovers) report.hovers.push_back(to_finger(hover.tip));
    if (frame.held) report.object = to_object(*frame.held);
    return report;
}

}  // namespace touchstone
