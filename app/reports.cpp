#include "app/reports.hpp"

namespace touchstone {

namespace {

std::array<double, 3> to_mm(const Eigen::Vector3f& point_m) {
    const Eigen::Vector3d point_mm = 1000.0 * point_m.cast<double>();
    return {point_mm.x(), point_mm.y(), point_mm.z()};
}

ReportedFinger to_finger(const Fingertip& tip, std::span<const NamedArea> areas) {
    ReportedFinger finger;
    finger.id = tip.id;
    finger.camera_mm = to_mm(tip.surface_c_m);
    finger.surface = {tip.area_uv.x(), tip.area_uv.y()};
    finger.height_mm = 1000.0 * static_cast<double>(tip.height_m);
    if (tip.area < 0 || tip.area >= std::ssize(areas)) return finger;
    finger.area = areas[static_cast<std::size_t>(tip.area)].name;
    finger.area_surface = {tip.named_uv.x(), tip.named_uv.y()};
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
    const Eigen::Quaterniond turn(held.T_c_o.linear().cast<double>());
    return {state_word(held.state),
            held.reason,
            to_mm(held.T_c_o.translation()),
            {turn.x(), turn.y(), turn.z(), turn.w()}};
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

TouchReport make_report(const InteractionFrame& frame, int index, std::uint64_t time_us,
                        std::span<const NamedArea> areas) {
    TouchReport report{index, time_us, state_word(frame.state), {}, {}};
    for (const TouchEvent& touch : frame.touches) {
        report.touches.push_back(to_finger(touch.tip, areas));
        report.touches.back().phase = to_phase(touch.phase);
    }
    for (const HoverEvent& hover : frame.hovers) report.hovers.push_back(to_finger(hover.tip, areas));
    if (frame.held) report.object = to_object(*frame.held);
    return report;
}

}  // namespace touchstone
