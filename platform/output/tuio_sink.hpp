#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "platform/output/touch_sink.hpp"
#include "platform/output/tuio_session.hpp"

namespace touchstone {

struct TuioConfig {
    std::string host = "127.0.0.1";
    int port = 3333;
    std::string
        source;  ///< clients keep the cursors of each source apart; empty: touchstone@ and the host's name
};

/// TUIO 1.1, profile /tuio/2Dcur, over UDP. A receiver that is not there is no error: it may start at any
/// time.
class TuioSink : public TouchSink {
  public:
    /// Says the empty table. Throws Error{configuration} where the host has no address or the port is none.
    explicit TuioSink(const TuioConfig& config);
    /// Says twice that all touches are over.
    ~TuioSink() override;
    void publish(const TouchReport& report) override;
    void release_all() override;
    void idle() override;

  private:
    struct AddressDeleter {
        void operator()(void* address) const;
    };
    void send(const TuioSession::Bundles& bundles);
    void send_part(const TuioBundle& bundle, std::size_t first_cursor, std::size_t cursors);

    std::string source_;
    std::unique_ptr<void, AddressDeleter> address_;  ///< liblo's lo_address
    TuioSession session_;
};

}  // namespace touchstone
