#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "app/check_report.hpp"
#include "app/config.hpp"
#include "platform/display/output_choice.hpp"
#include "platform/output/uinput_sink.hpp"

namespace touchstone {

/// The configuration file, if one is named; what it says is taken over where it can be read.
CheckLine check_configuration(const std::string& file, Config& config);

/// Every OpenCL device with its self-test, and how long a frame takes on the one that is configured: some
/// seconds.
std::vector<CheckLine> check_compute(const Config& config);

/// "fast" keeps 30 Hz with time to spare, and so on.
CheckLine speed_line(double median_frame_ms);

/// Drawing without a screen.
CheckLine check_drawing();

/// Screens and projectors with their modes, a line each.
std::vector<CheckLine> output_lines(std::span<const Output> outputs);

/// The device through which touches become those of a touch screen.
CheckLine check_uinput(const std::filesystem::path& node = uinput_node);

/// Whether systemd starts touchstone by itself.
CheckLine check_service(const std::filesystem::path& root = "/");

/// The folder, or the nearest one above it that is there.
std::filesystem::path existing_part(const std::filesystem::path& folder);

/// Room for kernel cache and scan.
CheckLine check_disk(const std::filesystem::path& folder);

}  // namespace touchstone
