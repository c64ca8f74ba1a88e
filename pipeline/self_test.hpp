#pragma once

#include "platform/opencl/device.hpp"

namespace touchstone {

/// Runs every stage once on a small analytic scene and compares with what geometry says. Throws
/// Error{unavailable} naming device and stage: a device that computes wrongly must not be used.
void run_self_test(const Device& device);

}  // namespace touchstone
