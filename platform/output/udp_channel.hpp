#pragma once

#include <memory>
#include <string>

#include "platform/output/osc_bundle.hpp"

namespace touchstone {

/// OSC over UDP to one receiver, which may not be there yet.
class UdpChannel : public OscChannel {
  public:
    /// Throws Error{configuration} where the host has no address or the port is none.
    UdpChannel(const std::string& host, int port);
    std::size_t largest_bundle() const override;
    void send(const OscBundle& bundle) override;

  private:
    struct AddressDeleter {
        void operator()(void* address) const;
    };
    std::unique_ptr<void, AddressDeleter> address_;  ///< liblo's lo_address
};

}  // namespace touchstone
