// tuio_replay PORT SCRIPT EVENTS [--killed]: publishes the event lines of SCRIPT, one a millisecond, through
// the TUIO sink and the event log. With --killed it dies by SIGKILL after the last line, without a word to
// the client.
#include <csignal>
#include <cstring>
#include <fstream>
#include <iostream>
#include <thread>

#include "platform/output/event_log.hpp"
#include "platform/output/tuio_sink.hpp"
#include "platform/output/udp_channel.hpp"
#include "tests/support/event_line_reader.hpp"

namespace touchstone {
namespace {

void replay(int port, const char* script, const char* events, bool killed) {
    std::ifstream file(script);
    TuioSink tuio(std::make_unique<UdpChannel>("127.0.0.1", port), "replay@127.0.0.1");
    EventLog log(events);
    for (std::string line; std::getline(file, line);) {
        const TouchReport report = report_of(line);
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
