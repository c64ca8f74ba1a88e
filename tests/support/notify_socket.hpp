#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <poll.h>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>
#include <vector>

namespace touchstone::test {

/// systemd's end of NOTIFY_SOCKET.
class NotifySocket {
  public:
    explicit NotifySocket(const std::filesystem::path& path) : descriptor_(socket(AF_UNIX, SOCK_DGRAM, 0)) {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        path.string().copy(address.sun_path, sizeof address.sun_path - 1);
        if (bind(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
            throw std::runtime_error("cannot bind " + path.string());
    }
    ~NotifySocket() { close(descriptor_); }
    NotifySocket(const NotifySocket&) = delete;
    NotifySocket& operator=(const NotifySocket&) = delete;

    /// What comes until the time is over, or until `enough`.
    template <class Enough>
    std::vector<std::string> read(std::chrono::milliseconds most, Enough enough) {
        const auto end = std::chrono::steady_clock::now() + most;
        using namespace std::chrono_literals;
        std::vector<std::string> messages;
        while (!enough(messages)) {
            const auto left =
                std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
            pollfd wanted{descriptor_, POLLIN, 0};
            if (left < 0ms || poll(&wanted, 1, static_cast<int>(left.count())) <= 0) break;
            std::array<char, 4096> bytes{};
            const ssize_t count = recv(descriptor_, bytes.data(), bytes.size(), 0);
            if (count > 0) messages.emplace_back(bytes.data(), static_cast<std::size_t>(count));
        }
        return messages;
    }
    std::vector<std::string> read(std::chrono::milliseconds time) {
        return read(time, [](const std::vector<std::string>&) { return false; });
    }

  private:
    int descriptor_;
};

}  // namespace touchstone::test
