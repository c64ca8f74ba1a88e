// What a client sends to the server of web pages, instead of a handshake and after one.
#include <lo/lo.h>
#include <poll.h>

#include "platform/output/web_socket_channel.hpp"
#include "tests/fuzz/support.hpp"
#include "tests/platform/output/web_socket_client.hpp"

namespace touchstone::fuzz {
namespace {

struct Server {
    Server() { set_log_level(LogLevel::error); }
    WebSocketChannel channel{WebSocketConfig{.host = "127.0.0.1", .port = 0, .origin = {}}};
    const WebSocketClient listener{channel.port()};
    int inputs = 0;
};

Server& server() {
    static Server made;
    return made;
}

/// The next bundle has come. A listener that answered no ping would be hung up on.
bool hears(const WebSocketClient& listener) {
    constexpr unsigned ping = 9;
    for (;;) {
        const auto message = listener.take();
        if (!message || message->opcode != ping) return message.has_value();
        listener.tcp().write(std::string("\x8a\x80\0\0\0\0", 6));
    }
}

/// The connection's bytes in two writes, then its end. A client that listens gets its bundle every time.
void send(std::string_view bytes) {
    {
        const TcpClient client(server().channel.port());
        const std::size_t half = bytes.size() / 2;
        client.write(std::string(bytes.substr(0, half)));
        client.write(std::string(bytes.substr(half)));
    }
    if (++server().inputs % 16 != 0) return;
    server().channel.send(OscBundle(lo_bundle_new(LO_TT_IMMEDIATE)));
    if (!hears(server().listener)) {
        std::fprintf(stderr, "who listens hears nothing any more\n");
        std::abort();
    }
}

}  // namespace

std::vector<std::string> seeds() {
    const std::string hello = WebSocketClient::handshake();
    // A text, a ping, a close, one with a length of 64 bit, one in two frames; all masked with zeros.
    const std::string mask(4, '\0');
    return {hello,
            hello + "\x81\x85" + mask + "hello",
            hello + "\x89\x84" + mask + "ping" + "\x88\x80" + mask,
            hello + "\x82\xff" + std::string(7, '\0') + "\x05" + mask + "bytes",
            hello + "\x01\x82" + mask + "he" + "\x80\x83" + mask + "llo",
            WebSocketClient::handshake("Origin: http://localhost:8000\r\nSec-WebSocket-Protocol: tuio\r\n"),
            "GET /index.html HTTP/1.1\r\nHost: a\r\nContent-Length: 5\r\n\r\nhello"};
}

}  // namespace touchstone::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    touchstone::fuzz::send(touchstone::fuzz::text_of(bytes, size));
    return 0;
}
