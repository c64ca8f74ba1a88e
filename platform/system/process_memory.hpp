#pragma once

#include <string>
#include <sys/resource.h>

namespace touchstone {

/// The most memory that this process had in RAM so far, megabytes.
inline double peak_rss_mb() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) * 1024.0 / 1e6;
}

/// What a process has now, megabytes: its number, or this one.
double resident_mb(const std::string& process = "self");

}  // namespace touchstone
