#pragma once

#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <cstdint>
#include <netinet/in.h>
#include <optional>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

namespace touchstone {

/// A TCP connection to a port of this machine, from its making to its end; reads wait two seconds at most.
class TcpClient {
  public:
    explicit TcpClient(int port, const std::string& host = "127.0.0.1")
        : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        inet_pton(AF_INET, host.c_str(), &address.sin_addr);
        const timeval longest{2, 0};
        ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
        ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &longest, sizeof longest);
        is_connected_ = ::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
    }
    ~TcpClient() { ::close(socket_); }
    TcpClient(const TcpClient&) = delete;
    TcpClient& operator=(const TcpClient&) = delete;

    bool is_connected() const { return is_connected_; }
    void write(const std::string& bytes) const {
        (void)!::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    }
    /// Exactly so many bytes; fewer where the connection ends or two seconds pass.
    std::string read(std::size_t count) const {
        std::string bytes(count, '\0');
        std::size_t have = 0;
        while (have < count) {
            const ssize_t got = ::recv(socket_, bytes.data() + have, count - have, 0);
            if (got < 0 && errno == EINTR) continue;  // libFuzzer has a timer
            if (got <= 0) break;
            have += static_cast<std::size_t>(got);
        }
        bytes.resize(have);
        return bytes;
    }
    /// Up to and with `end`; what came where it does not come.
    std::string read_until(const std::string& end) const {
        std::string text;
        while (!text.ends_with(end)) {
            const std::string next = read(1);
            if (next.empty()) break;
            text += next;
        }
        return text;
    }

  private:
    int socket_;
    bool is_connected_ = false;
};

/// RFC 6455 as far as a listener needs it, written from its text: the handshake with its example of a key,
/// and unmasked messages in one frame.
class WebSocketClient {
  public:
    explicit WebSocketClient(int port, const std::string& more_headers = {}) : tcp_(port) {
        tcp_.write(handshake(more_headers));
        answer_ = tcp_.read_until("\r\n\r\n");
    }

    static std::string handshake(const std::string& more_headers = {}) {
        return "GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
               "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n" +
               more_headers + "\r\n";
    }

    /// The server has agreed.
    bool is_open() const {
        return answer_.starts_with("HTTP/1.1 101") &&
               answer_.find("s3pPLMBiTxaQ9kYGzzhZRbK+xOo=") != std::string::npos;
    }
    const std::string& answer() const { return answer_; }
    const TcpClient& tcp() const { return tcp_; }

    struct Message {
        unsigned opcode = 0;
        std::string payload;
    };
    /// The next one; nothing where none comes within two seconds.
    std::optional<Message> take() const {
        const std::string head = tcp_.read(2);
        if (head.size() < 2 || (head[0] & 0x70) != 0 || (head[1] & 0x80) != 0) return std::nullopt;
        std::size_t size = static_cast<unsigned char>(head[1]);
        if (size == 126) size = number(tcp_.read(2));
        if (size == 127) size = number(tcp_.read(8));
        const std::string payload = tcp_.read(size);
        if (payload.size() < size) return std::nullopt;
        return Message{static_cast<unsigned char>(head[0]) & 0x0fu, payload};
    }

  private:
    static std::size_t number(const std::string& bytes) {
        std::size_t value = 0;
        for (const char byte : bytes) value = value << 8 | static_cast<unsigned char>(byte);
        return value;
    }

    TcpClient tcp_;
    std::string answer_;
};

}  // namespace touchstone
