#include "platform/system/process_memory.hpp"

#include <fstream>
#include <unistd.h>

namespace touchstone {

double resident_mb(const std::string& process) {
    double all_pages = 0.0, resident_pages = 0.0;
    std::ifstream("/proc/" + process + "/statm") >> all_pages >> resident_pages;
    return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

}  // namespace touchstone
