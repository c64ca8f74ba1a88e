#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "platform/system/error.hpp"

namespace touchstone {

/// The failure that a driver of ours left in OpenNI's extended error (driver_properties.h), or nothing.
std::optional<Error> driver_error_in(std::string_view extended_error);

/// OpenNI's extended error as one line.
std::string one_line(std::string_view extended_error);

}  // namespace touchstone
