#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>

#include "app/command_line.hpp"
#include "platform/display/sdl_display.hpp"
#include "platform/display/simulated_projector.hpp"

namespace touchstone {

/// What was asked for, else a window where there is a desktop.
DisplayKind choose_display(std::optional<DisplayKind> wanted);

/// Throws Error{unavailable} where there is no display of the kind.
std::unique_ptr<Display> open_display(DisplayKind kind, const DisplayConfig& config, WindowPixels pixels);

/// Whether a sensor URI asks for a simulated projector over the simulated table.
bool has_simulated_projector(const std::string& sensor_uri);

/// Such a projector: off screen, as large as the simulator thinks it.
std::unique_ptr<SimulatedProjector> open_simulated_projector();

/// Hands over a simulated table touch that pixel; none: they do not know of any. Nothing on other displays.
void show_to_simulated_hands(Display& display, const std::optional<Eigen::Vector2f>& cross_px);

/// For `run`: a simulated projector where the sensor has one, else as chosen.
std::unique_ptr<Display> open_display(const RunOptions& options);

/// Whether the picture can fall on the table.
bool is_projector(const RunOptions& options);

/// Whether the picture falls on the table and can be fitted to it: it comes from a projector that is
/// calibrated.
bool throws_on_table(const RunOptions& options);

}  // namespace touchstone
