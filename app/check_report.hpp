#pragma once

#include <string>
#include <vector>

#include "platform/system/error.hpp"

namespace touchstone {

enum class CheckStatus {
    ok,
    warn,  ///< works, but not as well or not by itself
    fail,  ///< does not work
};

/// One line of `touchstone check`.
struct CheckLine {
    std::string subject;
    CheckStatus status = CheckStatus::ok;
    std::string finding;
    std::string advice;  ///< what to do; empty where all is well
};

/// A page for people.
std::string check_text(const std::vector<CheckLine>& lines);

/// {"status":"ok|warn|fail","checks":[{"subject":..,"status":..,"finding":..,"advice":..}]}; the status is
/// the worst one.
std::string check_json(const std::vector<CheckLine>& lines);

/// Success unless a line has failed.
ExitStatus check_exit_status(const std::vector<CheckLine>& lines);

}  // namespace touchstone
