#include "platform/output/udp_channel.hpp"

#include <array>
#include <fmt/core.h>
#include <lo/lo.h>
#include <netdb.h>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

constexpr std::size_t largest_datagram = 1472;  // bytes: an Ethernet frame less the headers of IP and UDP

/// The numeric address of a host. Looked up once: a name server that is slow must not hold up frames.
std::string address_of(const std::string& host) {
    addrinfo hints{};
    hints.ai_socktype = SOCK_DGRAM;
    addrinfo* found = nullptr;
    const int failure = ::getaddrinfo(host.c_str(), nullptr, &hints, &found);
    if (failure != 0) {
        throw Error(ExitStatus::configuration,
                    fmt::format("TUIO host {}: {}; name a host that this machine can reach", host,
                                ::gai_strerror(failure)));
    }
    std::array<char, NI_MAXHOST> text{};
    ::getnameinfo(found->ai_addr, found->ai_addrlen, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST);
    ::freeaddrinfo(found);
    return text.data();
}

lo_address open_address(const std::string& host, int port) {
    if (port < 1 || port > 65535)
        throw Error(ExitStatus::configuration, fmt::format("TUIO port {}: give one of 1 to 65535", port));
    return lo_address_new(address_of(host).c_str(), std::to_string(port).c_str());
}

}  // namespace

void UdpChannel::AddressDeleter::operator()(void* address) const {
    lo_address_free(static_cast<lo_address>(address));
}

UdpChannel::UdpChannel(const std::string& host, int port) : address_(open_address(host, port)) {}

std::size_t UdpChannel::largest_bundle() const { return largest_datagram; }

void UdpChannel::send(const OscBundle& bundle) {
    // A receiver that is not there, or a cable that is out, is seen here as an error: later datagrams may
    // arrive.
    lo_send_bundle(address_.get(), bundle.get());
}

}  // namespace touchstone
