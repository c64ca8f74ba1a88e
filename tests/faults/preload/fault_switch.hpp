#pragma once

#include <cstdlib>
#include <unistd.h>

/// Whether the test has asked for the fault: a file that the environment names is there.
inline bool fault_is_on() {
    static const char* const file = std::getenv("TOUCHSTONE_FAULT_SWITCH");
    return file != nullptr && access(file, F_OK) == 0;
}
