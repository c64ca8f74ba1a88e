#pragma once

#include <string>

namespace touchstone {

/// Walks through all of an .oni file but its pictures. OpenNI's player believes what a file says of itself
/// and writes past its buffers where that is wrong. Throws Error: no_input where it is missing, bad_data
/// where it is none, is cut short, or says what it cannot hold.
void check_recording(const std::string& path);

}  // namespace touchstone
