#pragma once

#include <string>

namespace touchstone {

/// Takes all errors GL has noted since the last call, as "0x0502 0x0501"; empty when there was none.
std::string take_gl_errors();

/// Vendor, renderer and version of the current context, in one line.
std::string gl_description();

}  // namespace touchstone
