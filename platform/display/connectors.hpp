#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "platform/display/output_choice.hpp"

namespace touchstone {

/// A socket of a graphics card, as the kernel tells.
struct Connector {
    std::string name;   ///< "HDMI-A-1"
    std::string model;  ///< what the screen or projector in it calls itself; may be empty
    bool connected = false;
    std::vector<PixelSize> sizes;  ///< each once, the best one first
};

/// From the kernel's folder of outputs, by name.
std::vector<Connector> list_connectors(const std::filesystem::path& drm = "/sys/class/drm");
/// Whether something is plugged into it.
bool is_connected(const std::string& connector, const std::filesystem::path& drm = "/sys/class/drm");

/// The connected ones in the order in which graphics cards count them; by name where no card may be opened.
std::vector<Connector> in_card_order(std::vector<Connector> connectors,
                                     const std::filesystem::path& dri = "/dev/dri");

/// The name in the EDID of a screen; empty where it has none.
std::string model_of_edid(std::span<const std::uint8_t> edid);

/// Window systems name an output after its model, a bare console gives it a number: puts the connector's name
/// before the one, in place of the other. `connectors` are in_card_order.
std::vector<Output> named_after_connectors(std::vector<Output> outputs, std::vector<Connector> connectors);

/// The outputs as the kernel knows them, without rates: where nothing else tells.
std::vector<Output> outputs_of(std::span<const Connector> connectors);

/// Why a bare console can show nothing, and what to do; empty where it seems to be able to.
std::string console_problem(const std::filesystem::path& dri = "/dev/dri",
                            const std::filesystem::path& drm = "/sys/class/drm");

}  // namespace touchstone
