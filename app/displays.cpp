#include "app/displays.hpp"

#include <cstdlib>
#include <filesystem>

#include "platform/display/headless_display.hpp"
#include "platform/display/projector_display.hpp"

namespace touchstone {
namespace {

constexpr PixelSize simulated_size{1280, 800};

}  // namespace

DisplayKind choose_display(std::optional<DisplayKind> wanted) {
    if (wanted) return *wanted;
    const bool desktop = std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
    return desktop ? DisplayKind::window : DisplayKind::headless;
}

std::unique_ptr<Display> open_display(DisplayKind kind, const DisplayConfig& config, WindowPixels pixels) {
    const PixelSize size{config.width_px, config.height_px};
    switch (kind) {
        case DisplayKind::window:
            return make_sdl_display("Touchstone", size, pixels);
        case DisplayKind::projector:
            return make_projector_display("Touchstone", {config.output, config.mode, pixels});
        case DisplayKind::headless:
            break;
    }
    return make_headless_display(size);
}

bool has_simulated_projector(const std::string& sensor_uri) {
    return sensor_uri.starts_with("sim:") && (sensor_uri.find("?projector=1") != std::string::npos ||
                                              sensor_uri.find("&projector=1") != std::string::npos);
}

std::unique_ptr<SimulatedProjector> open_simulated_projector() {
    return std::make_unique<SimulatedProjector>(make_headless_display(simulated_size),
                                                projected_picture_name());
}

void show_to_simulated_hands(Display& display, const std::optional<Eigen::Vector2f>& cross_px) {
    auto* simulated = dynamic_cast<SimulatedProjector*>(&display);
    if (simulated == nullptr) return;
    simulated->set_aim(cross_px ? std::optional(std::array{cross_px->x(), cross_px->y()}) : std::nullopt);
}

std::unique_ptr<Display> open_display(const RunOptions& options) {
    if (has_simulated_projector(options.config.sensor_uri)) return open_simulated_projector();
    const WindowPixels pixels = options.shots_dir ? WindowPixels::readable : WindowPixels::shown_only;
    return open_display(choose_display(options.display), options.config.display, pixels);
}

bool is_projector(const RunOptions& options) {
    return has_simulated_projector(options.config.sensor_uri) || options.display == DisplayKind::projector;
}

bool throws_on_table(const RunOptions& options) {
    const std::string& calibration = options.config.projector.file;
    std::error_code none;
    return is_projector(options) && !calibration.empty() && std::filesystem::exists(calibration, none);
}

}  // namespace touchstone
