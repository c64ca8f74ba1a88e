// touch_player PORT: publishes each event line of standard input by WebSocket when it comes. Says the port,
// which is any where PORT is 0.
#include <cstdlib>
#include <iostream>

#include "platform/output/tuio_sink.hpp"
#include "platform/output/web_socket_channel.hpp"
#include "tests/support/event_line_reader.hpp"

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: touch_player PORT\n";
        return 64;
    }
    auto channel = std::make_unique<touchstone::WebSocketChannel>(
        touchstone::WebSocketConfig{.port = std::atoi(argv[1]), .origin = {}});
    std::cout << channel->port() << std::endl;
    touchstone::TuioSink sink(std::move(channel), "player@127.0.0.1");
    for (std::string line; std::getline(std::cin, line);) sink.publish(touchstone::report_of(line));
}
