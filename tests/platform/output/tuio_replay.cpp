// tuio_replay PORT SCRIPT EVENTS [--killed]: publishes the event lines of SCRIPT, one a millisecond, through
// the TUIO sink and the event log. With --killed it dies by SIGKILL after the last line, without a word to
// the client.
#include <csignal>
#include <cstring>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "platform/output/event_log.hpp"
#include "platform/output/tuio_sink.hpp"
#include "platform/output/udp_channel.hpp"

namespace touchstone {
namespace {

ReportedFinger finger_of(const nlohmann::json& object) {
    ReportedFinger finger;
    finger.id = object.at("id");
    const std::string phase = object.value("phase", "move");
    finger.phase = phase == "down" ? ReportedPhase::down
                   : phase == "up" ? ReportedPhase::up
                                   : ReportedPhase::move;
    finger.camera_mm = object.at("camera_mm");
    finger.surface = object.at("surface");
    finger.height_mm = object.at("height_mm");
    return finger;
}

TouchReport report_of(const nlohmann::json& line) {
    TouchReport report;
    report.frame = line.at("frame");
    report.time_us = line.at("time_us");
    report.state = line.at("state");
    for (const auto& touch : line.at("touches")) report.touches.push_back(finger_of(touch));
    for (const auto& hover : line.at("hovers")) report.hovers.push_back(finger_of(hover));
    return report;
}

void replay(int port, const char* script, const char* events, bool killed) {
    std::ifstream file(script);
    TuioSink tuio(std::make_unique<UdpChannel>("127.0.0.1", port), "replay@127.0.0.1");
    EventLog log(events);
    for (std::string line; std::getline(file, line);) {
        const TouchReport report = report_of(nlohmann::json::parse(line));
        tuio.publish(report);
        log.publish(report);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (killed) std::raise(SIGKILL);
}

}  // namespace
}  // namespace touchstone

int main(int argc, char** argv) {
    if (argc < 4) {
        std::cerr << "usage: tuio_replay PORT SCRIPT EVENTS [--killed]\n";
        return 64;
    }
    touchstone::replay(std::atoi(argv[1]), argv[2], argv[3],
                       argc > 4 && std::strcmp(argv[4], "--killed") == 0);
}
