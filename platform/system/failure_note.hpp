#pragma once

#include <string>

namespace touchstone {

/// Why the service ended last, in its state folder ($STATE_DIRECTORY, of systemd): for the screen that is
/// shown instead. Where there is no such folder, or it cannot be written, nothing is kept.
void keep_failure(const std::string& reason);
void forget_failure();
/// Empty where none is kept.
std::string kept_failure();

}  // namespace touchstone
