#pragma once

#include <memory>
#include <string>

#include "platform/output/osc_bundle.hpp"

namespace touchstone {

struct WebSocketConfig {
    std::string host = "127.0.0.1";  ///< own address or network interface on which clients are served
    int port = 3343;                 ///< 0: any
    std::string origin;              ///< of pages that may listen beside those of this machine; *: all
};

/// OSC to whoever connects by WebSocket, each bundle a binary message. Served by a thread of its own: a
/// client that is slow or stuck holds up nobody and loses the oldest bundles.
class WebSocketChannel : public OscChannel {
  public:
    /// Throws Error{unavailable} where address and port cannot be had.
    explicit WebSocketChannel(const WebSocketConfig& config);
    /// What was sent last still goes out, to clients that take it within 200 ms.
    ~WebSocketChannel() override;
    std::size_t largest_bundle() const override;
    void send(const OscBundle& bundle) override;
    int port() const;

  private:
    class Server;
    std::unique_ptr<Server> server_;
};

}  // namespace touchstone
