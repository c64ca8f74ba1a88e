#include "app/check_report.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace touchstone {
namespace {

const char* word(CheckStatus status) {
    switch (status) {
        case CheckStatus::ok:
            return "ok";
        case CheckStatus::warn:
            return "warn";
        case CheckStatus::fail:
            break;
    }
    return "fail";
}

CheckStatus worst(const std::vector<CheckLine>& lines) {
    CheckStatus status = CheckStatus::ok;
    for (const CheckLine& line : lines) status = std::max(status, line.status);
    return status;
}

std::string closing_line(const std::vector<CheckLine>& lines) {
    const auto count = [&](CheckStatus status) {
        return std::count_if(lines.begin(), lines.end(),
                             [&](const CheckLine& line) { return line.status == status; });
    };
    switch (worst(lines)) {
        case CheckStatus::ok:
            return "Ready.\n";
        case CheckStatus::warn:
            return fmt::format("Ready, with {} warning(s).\n", count(CheckStatus::warn));
        case CheckStatus::fail:
            break;
    }
    return fmt::format("Not ready: {} failure(s), {} warning(s).\n", count(CheckStatus::fail),
                       count(CheckStatus::warn));
}

}  // namespace

std::string check_text(const std::vector<CheckLine>& lines) {
    std::string text;
    for (const CheckLine& line : lines) {
        text += fmt::format("{:<5} {:<14} {}\n", word(line.status), line.subject, line.finding);
        if (!line.advice.empty()) text += fmt::format("{:<20} -> {}\n", "", line.advice);
    }
    return text + "\n" + closing_line(lines);
}

std::string check_json(const std::vector<CheckLine>& lines) {
    nlohmann::ordered_json json;
    json["status"] = word(worst(lines));
    json["checks"] = nlohmann::ordered_json::array();
    for (const CheckLine& line : lines) {
        json["checks"].push_back({{"subject", line.subject},
                                  {"status", word(line.status)},
                                  {"finding", line.finding},
                                  {"advice", line.advice}});
    }
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

ExitStatus check_exit_status(const std::vector<CheckLine>& lines) {
    if (worst(lines) != CheckStatus::fail) return ExitStatus::ok;
    const bool only_configuration = std::ranges::all_of(lines, [](const CheckLine& line) {
        return line.status != CheckStatus::fail || line.subject == "configuration";
    });
    return only_configuration ? ExitStatus::configuration : ExitStatus::unavailable;
}

}  // namespace touchstone
