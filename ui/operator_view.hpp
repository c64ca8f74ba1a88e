#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "platform/display/picture.hpp"
#include "platform/system/stage_timer.hpp"

namespace touchstone {

/// A small gray picture, row-major.
struct Thumbnail {
    PixelSize size;
    std::vector<std::uint8_t> gray;
};

/// What the perception loop tells the operator.
struct OperatorView {
    std::string camera, device;
    float camera_rate_hz = 0.f;  ///< what the camera promises
    std::vector<StageSummary> stages;
    std::vector<std::string> faults;  ///< the last ones, newest first: when and why
    bool can_record = false;
    bool can_calibrate_projector = false;  ///< there is one, and a file to keep it in
    std::string projector;                 ///< what became of its last calibration or check
    bool can_change_areas = false;         ///< there is a file to keep them in
    int area_lists = 0;                    ///< how many of the operator's lists have been looked at
    std::string areas;                     ///< why the last one was refused; empty: it was not
    std::string recording;                 ///< how far it is, where the last one lies, or why there is none
    Thumbnail depth;                       ///< near is bright, nothing measured is black
    Thumbnail mask;                        ///< the foreground is white
};

/// A named area as the operator wants it.
struct AreaDraft {
    std::string name;                           ///< empty: a new one
    std::string scene;                          ///< empty: the table's
    std::vector<Eigen::Vector2f> corners_uv{};  ///< of a new one: shares of the interactive area's axes
};

/// What the operator asks of the perception loop, how often up to now, and what he ought to know.
struct OperatorWish {
    bool open = false;  ///< an OperatorView is wanted
    int rescans = 0;
    int recalibrations = 0;  ///< of touches
    int recordings = 0;      ///< of the 10 s to come
    int projector_calibrations = 0;
    int area_lists = 0;  ///< the last of which is areas
    std::vector<AreaDraft> areas{};
    std::string unsaved{};  ///< why the painting is not on the disk; empty when nothing is wrong
};

}  // namespace touchstone
