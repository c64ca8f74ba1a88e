#pragma once

#include <arpa/inet.h>
#include <array>
#include <cstdint>
#include <netinet/in.h>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>
#include <vector>

namespace touchstone {

/// A UDP port of the loopback interface; 0 lets the system choose.
class UdpReceiver {
  public:
    explicit UdpReceiver(int port = 0) : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        const timeval longest{2, 0};
        ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
        socklen_t size = sizeof address;
        if (::bind(socket_, reinterpret_cast<sockaddr*>(&address), size) != 0 ||
            ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
            throw std::runtime_error("no UDP port");
        }
        port_ = ntohs(address.sin_port);
    }
    ~UdpReceiver() { ::close(socket_); }
    UdpReceiver(const UdpReceiver&) = delete;
    UdpReceiver& operator=(const UdpReceiver&) = delete;

    int port() const { return port_; }
    int socket() const { return socket_; }

    /// The next datagram; empty where none came within two seconds.
    std::string take() const {
        std::array<char, 65536> bytes{};
        const ssize_t size = ::recv(socket_, bytes.data(), bytes.size(), 0);
        return size < 0 ? std::string() : std::string(bytes.data(), static_cast<std::size_t>(size));
    }

    /// What has arrived already.
    std::vector<std::string> take_all() const {
        std::vector<std::string> datagrams;
        std::array<char, 65536> bytes{};
        for (ssize_t size; (size = ::recv(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT)) >= 0;) {
            datagrams.emplace_back(bytes.data(), static_cast<std::size_t>(size));
        }
        return datagrams;
    }

  private:
    int socket_;
    int port_ = 0;
};

}  // namespace touchstone
