#include "platform/output/event_log.hpp"

#include <cerrno>
#include <cmath>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <system_error>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

using Json = nlohmann::ordered_json;

double rounded(double value, double steps) { return std::round(value * steps) / steps + 0.0; }
double rounded_mm(double mm) { return rounded(mm, 100.0); }
double rounded_share(double share) { return rounded(share, 100000.0); }

const char* phase_word(ReportedPhase phase) {
    switch (phase) {
        case ReportedPhase::down:
            return "down";
        case ReportedPhase::move:
            return "move";
        case ReportedPhase::up:
            return "up";
    }
    return "move";
}

void add_place(Json& object, const ReportedFinger& finger) {
    const auto& mm = finger.camera_mm;
    if (!finger.area.empty()) object["area"] = finger.area;
    object["camera_mm"] = {rounded_mm(mm[0]), rounded_mm(mm[1]), rounded_mm(mm[2])};
    object["surface"] = {rounded_share(finger.surface[0]), rounded_share(finger.surface[1])};
    object["height_mm"] = rounded_mm(finger.height_mm);
}

void add_object(Json& line, const ReportedObject& object) {
    Json& entry = line["object"];
    entry["state"] = object.state;
    if (!object.reason.empty()) entry["reason"] = object.reason;
    if (object.state != "tracked") return;
    entry["camera_mm"] = Json::array();
    for (const double mm : object.camera_mm) entry["camera_mm"].push_back(rounded_mm(mm));
    entry["quaternion"] = Json::array();
    for (const double part : object.quaternion) entry["quaternion"].push_back(rounded_share(part));
}

[[noreturn]] void fail(const char* what, const std::string& name, int code) {
    throw Error(ExitStatus::io_error, fmt::format("cannot {} the event log {}: {}", what, name,
                                                  std::generic_category().message(code)));
}

}  // namespace

std::string event_line(const TouchReport& report) {
    Json line;
    line["frame"] = report.frame;
    line["time_us"] = report.time_us;
    line["state"] = report.state;
    line["touches"] = Json::array();
    for (const ReportedFinger& touch : report.touches) {
        Json& object = line["touches"].emplace_back();
        object["id"] = touch.id;
        object["phase"] = phase_word(touch.phase);
        add_place(object, touch);
    }
    line["hovers"] = Json::array();
    for (const ReportedFinger& hover : report.hovers) {
        Json& object = line["hovers"].emplace_back();
        object["id"] = hover.id;
        add_place(object, hover);
    }
    if (report.object) add_object(line, *report.object);
    return line.dump();
}

void EventLog::Closer::operator()(std::FILE* file) const {
    if (file != stdout) std::fclose(file);
}

EventLog::EventLog(const std::filesystem::path& path)
    : name_(path == "-" ? "on standard output" : path.string()),
      file_(path == "-" ? stdout : std::fopen(path.c_str(), "we")) {
    if (!file_) fail("open", name_, errno);
}

void EventLog::publish(const TouchReport& report) {
    const std::string line = event_line(report) + '\n';
    if (std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size() ||
        std::fflush(file_.get()) != 0) {
        fail("write", name_, errno);
    }
}

}  // namespace touchstone
