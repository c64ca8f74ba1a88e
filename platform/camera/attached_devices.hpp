#pragma once

#include <optional>
#include <string>

namespace touchstone {

/// URI of the first depth camera that a driver has announced, leaving out files and simulations opened
/// before, which OpenNI lists too. A SensorSession must live.
std::optional<std::string> first_attached_device();

}  // namespace touchstone
