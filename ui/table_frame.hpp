#pragma once

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/particle_view.hpp"
#include "pipeline/projector_model.hpp"
#include "pipeline/scene_wish.hpp"
#include "pipeline/surface_grid.hpp"
#include "pipeline/touch_event.hpp"
#include "pipeline/types.hpp"
#include "ui/operator_view.hpp"
#include "ui/thrown_picture.hpp"

namespace touchstone {

/// What the perception loop hands to the presentation loop through the mailbox: the latest result only. Touch
/// events are the exception: the mailbox keeps those of frames that were never drawn, so that no stroke is
/// torn.
struct TableFrame {
    int index = 0;
    std::uint64_t timestamp_us = 0;
    std::chrono::steady_clock::time_point arrived{};  ///< the camera's frame, from the driver
    std::string state;           ///< starting, scanning, live, sensor_lost: the words of the event log
    float scan_progress = 0.f;   ///< 0..1 while scanning
    int scan_frames_done = 0;    ///< while scanning
    int scan_frames_wanted = 0;  ///< 0 when not known: then only scan_progress is shown
    float frame_rate_hz = 0.f;   ///< of the perception loop
    float frame_ms = 0.f;        ///< time the pipeline took, median of late
    std::string note;            ///< one line for the operator, empty when all is well
    std::shared_ptr<const ShadedView> view;  ///< may be null before the first frame
    bool view_is_camera = false;             ///< its own picture, not shaded
    std::array<Eigen::Vector2f, 4>
        area_px{};  ///< corners of the interactive area in the view, in order around it
    bool has_area = false;
    InteractiveArea area;                               ///< where there is one
    Intrinsics intrinsics{};                            ///< of the depth camera
    RigidTransform T_g_c = RigidTransform::Identity();  ///< the camera's pose in the scan
    std::shared_ptr<const ParticleView> particles;      ///< while the scene wishes them, else null
    std::shared_ptr<const ProjectorModel> projector;    ///< likewise
    std::shared_ptr<const SurfaceGrid> surface;  ///< from the end of the scan on, where a projector lights it
    std::shared_ptr<const RenderedView> rendered;   ///< the last one the scene wished for, else null
    std::shared_ptr<const OperatorView> operating;  ///< while the operator wishes it, else null
    std::vector<TouchEvent> touches;
    std::vector<HoverEvent> hovers;
    std::optional<CrossGuide> cross;              ///< while touches are calibrated
    std::shared_ptr<const ThrownPicture> thrown;  ///< instead of the scene, while the projector is looked at
};

}  // namespace touchstone
