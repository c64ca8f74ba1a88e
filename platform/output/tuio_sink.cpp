#include "platform/output/tuio_sink.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <fmt/core.h>
#include <lo/lo.h>
#include <netdb.h>
#include <unistd.h>

#include "platform/system/error.hpp"

namespace touchstone {
namespace {

constexpr const char* profile = "/tuio/2Dcur";
constexpr std::size_t largest_datagram = 1472;  // bytes: an Ethernet frame less the headers of IP and UDP

struct BundleDeleter {
    void operator()(lo_bundle bundle) const { lo_bundle_free_recursive(bundle); }
};
using Bundle = std::unique_ptr<std::remove_pointer_t<lo_bundle>, BundleDeleter>;

/// The numeric address of a host. Looked up once: a name server that is slow must not hold up frames.
std::string address_of(const TuioConfig& config) {
    addrinfo hints{};
    hints.ai_socktype = SOCK_DGRAM;
    addrinfo* found = nullptr;
    const int failure = ::getaddrinfo(config.host.c_str(), nullptr, &hints, &found);
    if (failure != 0) {
        throw Error(ExitStatus::configuration,
                    fmt::format("TUIO host {}: {}; name a host that this machine can reach", config.host,
                                ::gai_strerror(failure)));
    }
    std::array<char, NI_MAXHOST> text{};
    ::getnameinfo(found->ai_addr, found->ai_addrlen, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST);
    ::freeaddrinfo(found);
    return text.data();
}

lo_address open_address(const TuioConfig& config) {
    if (config.port < 1 || config.port > 65535) {
        throw Error(ExitStatus::configuration,
                    fmt::format("TUIO port {}: give one of 1 to 65535", config.port));
    }
    return lo_address_new(address_of(config).c_str(), std::to_string(config.port).c_str());
}

std::string source_name(const TuioConfig& config) {
    if (!config.source.empty()) return config.source;
    std::array<char, 65> host{};
    ::gethostname(host.data(), host.size() - 1);
    return fmt::format("touchstone@{}", host.data());
}

void add_source(lo_bundle bundle, const std::string& source) {
    lo_message message = lo_message_new();
    lo_message_add_string(message, "source");
    lo_message_add_string(message, source.c_str());
    lo_bundle_add_message(bundle, profile, message);
}

void add_alive(lo_bundle bundle, const std::vector<std::int32_t>& sessions) {
    lo_message message = lo_message_new();
    lo_message_add_string(message, "alive");
    for (const std::int32_t session : sessions) lo_message_add_int32(message, session);
    lo_bundle_add_message(bundle, profile, message);
}

void add_set(lo_bundle bundle, const TuioCursor& cursor) {
    lo_message message = lo_message_new();
    lo_message_add_string(message, "set");
    lo_message_add_int32(message, cursor.session);
    for (const float value :
         {cursor.x, cursor.y, cursor.velocity_x, cursor.velocity_y, cursor.acceleration}) {
        lo_message_add_float(message, value);
    }
    lo_bundle_add_message(bundle, profile, message);
}

void add_fseq(lo_bundle bundle, std::int32_t fseq) {
    lo_message message = lo_message_new();
    lo_message_add_string(message, "fseq");
    lo_message_add_int32(message, fseq);
    lo_bundle_add_message(bundle, profile, message);
}

/// How many cursors fit in a datagram beside source, alive list and fseq.
std::size_t cursors_per_datagram(const TuioBundle& bundle, const std::string& source) {
    const Bundle frame(lo_bundle_new(LO_TT_IMMEDIATE));
    add_source(frame.get(), source);
    add_alive(frame.get(), bundle.alive);
    add_fseq(frame.get(), bundle.fseq);
    const std::size_t frame_bytes = lo_bundle_length(frame.get());
    add_set(frame.get(), {});
    const std::size_t set_bytes = lo_bundle_length(frame.get()) - frame_bytes;
    return std::max<std::size_t>(1, (largest_datagram - std::min(largest_datagram, frame_bytes)) / set_bytes);
}

}  // namespace

void TuioSink::AddressDeleter::operator()(void* address) const {
    lo_address_free(static_cast<lo_address>(address));
}

TuioSink::TuioSink(const TuioConfig& config)
    : source_(source_name(config)),
      address_(open_address(config)),
      session_(tuio_start(std::chrono::system_clock::now())) {
    send(session_.start(TuioSession::Clock::now()));
}

TuioSink::~TuioSink() { send(session_.release_all(TuioSession::Clock::now())); }

void TuioSink::publish(const TouchReport& report) { send(session_.frame(report, TuioSession::Clock::now())); }

void TuioSink::release_all() { send(session_.release_all(TuioSession::Clock::now())); }

void TuioSink::idle() { send(session_.refresh(TuioSession::Clock::now())); }

void TuioSink::send(const TuioSession::Bundles& bundles) {
    for (const TuioBundle& bundle : bundles) {
        const std::size_t at_once = cursors_per_datagram(bundle, source_);
        std::size_t first = 0;
        do {
            const std::size_t cursors = std::min(at_once, bundle.cursors.size() - first);
            send_part(bundle, first, cursors);
            first += cursors;
        } while (first < bundle.cursors.size());
    }
}

void TuioSink::send_part(const TuioBundle& bundle, std::size_t first_cursor, std::size_t cursors) {
    const Bundle datagram(lo_bundle_new(LO_TT_IMMEDIATE));
    add_source(datagram.get(), source_);
    add_alive(datagram.get(), bundle.alive);
    for (std::size_t i = 0; i < cursors; ++i) add_set(datagram.get(), bundle.cursors[first_cursor + i]);
    add_fseq(datagram.get(), bundle.fseq);
    // A receiver that is not there, or a cable that is out, is seen here as an error: later datagrams may
    // arrive.
    lo_send_bundle(static_cast<lo_address>(address_.get()), datagram.get());
}

}  // namespace touchstone
