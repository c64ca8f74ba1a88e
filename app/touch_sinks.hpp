#pragma once

#include <memory>
#include <vector>

#include "app/command_line.hpp"
#include "platform/output/touch_sink.hpp"

namespace touchstone {

/// Everything that is to be told of touches, as command line and configuration say. Throws Error where one
/// cannot be opened.
std::vector<std::unique_ptr<TouchSink>> make_touch_sinks(const RunOptions& options);

}  // namespace touchstone
