#pragma once

#include <memory>
#include <string>

#include "platform/display/sdl_display.hpp"

namespace touchstone {

struct ProjectorConfig {
    std::string output;  ///< as find_output
    std::string mode;    ///< as choose_mode
    WindowPixels pixels = WindowPixels::readable;
};

/// All of an output, without a cursor, which never goes dark: on a bare console or as a window of a desktop.
/// Where the output is pulled out drawing goes on unseen, until it is back. Events are taken on the thread
/// that made the display. Throws Error{unavailable} where there is no such output, or none at all, and
/// Error{configuration} for a mode that it does not have.
std::unique_ptr<Display> make_projector_display(const std::string& title, const ProjectorConfig& config);

}  // namespace touchstone
