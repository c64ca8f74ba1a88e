#include "app/displays.hpp"

#include <cstdlib>

#include "platform/display/headless_display.hpp"
#include "platform/display/sdl_display.hpp"

namespace touchstone {
namespace {

constexpr PixelSize simulated_size{1280, 800};

}  // namespace

DisplayKind choose_display(std::optional<DisplayKind> wanted) {
    if (wanted) return *wanted;
    const bool desktop = std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
    return desktop ? DisplayKind::window : DisplayKind::headless;
}

std::unique_ptr<Display> open_display(DisplayKind kind, const DisplayConfig& config) {
    const PixelSize size{config.width_px, config.height_px};
    return kind == DisplayKind::window ? make_sdl_display("Touchstone", size) : make_headless_display(size);
}

bool has_simulated_projector(const std::string& sensor_uri) {
    return sensor_uri.starts_with("sim:") && (sensor_uri.find("?projector=1") != std::string::npos ||
                                              sensor_uri.find("&projector=1") != std::string::npos);
}

std::unique_ptr<SimulatedProjector> open_simulated_projector() {
    return std::make_unique<SimulatedProjector>(make_headless_display(simulated_size),
                                                projected_picture_name());
}

}  // namespace touchstone
