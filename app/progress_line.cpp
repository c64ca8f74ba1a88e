#include "app/progress_line.hpp"

#include <iostream>
#include <unistd.h>

namespace touchstone {

namespace {

constexpr std::string_view start_of_line_and_erase = "\r\x1b[K";

}  // namespace

ProgressLine::ProgressLine()
    : ProgressLine(std::cerr, isatty(STDERR_FILENO) == 1, std::chrono::milliseconds(100)) {}

void ProgressLine::show(std::string_view text) {
    const auto now = std::chrono::steady_clock::now();
    if (!shown_ || (written_ && now - last_ < interval_)) return;
    *out_ << start_of_line_and_erase << text << std::flush;
    last_ = now;
    written_ = true;
}

void ProgressLine::clear() {
    if (written_) *out_ << start_of_line_and_erase << std::flush;
    written_ = false;
}

}  // namespace touchstone
