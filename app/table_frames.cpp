#include "app/table_frames.hpp"

#include "app/reports.hpp"

namespace touchstone {

TableFrame make_table_frame(InteractionPipeline& pipeline, const InteractionFrame& result,
                            const DepthFrame& frame, int scan_frames_wanted, bool shows_camera) {
    TableFrame shown;
    shown.index = frame.index;
    shown.timestamp_us = frame.timestamp_us;
    shown.state = state_word(result.state);
    shown.scan_progress = result.scan_progress;
    shown.scan_frames_done = result.scan_frames_done;
    shown.scan_frames_wanted = scan_frames_wanted;
    shown.note = result.note;
    shown.view_is_camera = shows_camera && !frame.color_rgb.empty();
    if (shown.view_is_camera)
        shown.view = std::make_shared<ShadedView>(
            camera_view(frame.color_rgb, pipeline.foreground_map(), frame.intrinsics));
    else if (result.state != InteractionState::starting)
        shown.view = std::make_shared<ShadedView>(pipeline.view());
    if (const auto& area = pipeline.area()) {
        shown.has_area = true;
        shown.area_px = area_corners_px(*area, frame.intrinsics);
        shown.area = *area;
    }
    shown.intrinsics = frame.intrinsics;
    if (pipeline.background()) shown.T_g_c = pipeline.background()->T_g_c();
    shown.touches = result.touches;
    shown.hovers = result.hovers;
    return shown;
}

}  // namespace touchstone
