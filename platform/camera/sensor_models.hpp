#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/shared_types.h"

namespace touchstone {

/// Size and rate of a camera's depth picture.
struct DepthMode {
    int width_px = 640, height_px = 480, rate_hz = 30;
    bool operator==(const DepthMode&) const = default;
};

/// "640x480@30"; nothing for anything else.
std::optional<DepthMode> parse_depth_mode(std::string_view text);
std::string to_text(const DepthMode& mode);

struct UsbId {
    std::uint16_t vendor = 0;
    std::optional<std::uint16_t> product;  ///< nothing: all of the vendor
};

/// What is known of a model of depth camera beyond what its driver tells.
struct SensorModel {
    std::string name;
    std::vector<UsbId> usb;
    DepthMode mode;
    SensorNoise noise{};
    std::vector<Intrinsics> intrinsics;  ///< by width; those of a width that is missing come from the driver
    std::string source;                  ///< of the numbers
};

/// From TOML (platform/camera/sensor_models.toml shows the form). Throws Error{configuration} naming `file`,
/// the line and what is wrong.
std::vector<SensorModel> parse_sensor_models(const std::string& text, const std::string& file);

/// Those of the file, if one is named, and after them the built-in ones. Throws Error{no_input} where it is
/// missing, else as parse_sensor_models.
std::vector<SensorModel> load_sensor_models(const std::string& file);

/// The first that has these numbers; null: none.
const SensorModel* find_sensor_model(const std::vector<SensorModel>& models, std::uint16_t vendor,
                                     std::uint16_t product);

}  // namespace touchstone
