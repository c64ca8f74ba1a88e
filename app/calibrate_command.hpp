#pragma once

#include <string>

#include "app/command_line.hpp"
#include "app/projector_calibration.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

/// {"method","model","rms_px","rms_mm","points","verdict"}.
std::string calibration_json(const CalibrationResult& result);

/// Finds which pixel of the projector lights which point of the scan: by crosses that are touched, or by
/// stripes that the colour camera sees. Keeps it in the configuration's file. bad_data where nothing of use
/// came out. Throws Error.
ExitStatus calibrate_command(const CalibrateOptions& options);

}  // namespace touchstone
