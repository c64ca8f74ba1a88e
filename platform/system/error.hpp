#pragma once

#include <stdexcept>
#include <string>

namespace touchstone {

/// Exit statuses of the program, from sysexits.h.
enum class ExitStatus {
    ok = 0,
    usage = 64,
    bad_data = 65,
    no_input = 66,
    unavailable = 69,
    io_error = 74,
    configuration = 78,
};

/// A failure that ends the program: `what()` is the one line for the user (what, where, what to do).
class Error : public std::runtime_error {
  public:
    Error(ExitStatus status, const std::string& message) : std::runtime_error(message), status_(status) {}
    ExitStatus status() const { return status_; }

  private:
    ExitStatus status_;
};

}  // namespace touchstone
