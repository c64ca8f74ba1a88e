#pragma once

#include <memory>
#include <optional>
#include <string>

#include "platform/output/osc_bundle.hpp"
#include "platform/output/touch_sink.hpp"
#include "platform/output/tuio_session.hpp"

namespace touchstone {

/// TUIO 1.1 over any channel: /tuio/2Dcur of the touches, or /tuio/25Dcur of hovers as well.
class TuioSink : public TouchSink {
  public:
    /// Says the empty table. Clients keep the cursors of each source apart; empty: touchstone@ and the host's
    /// name. With `unit_height_mm`, which is 1 on the axis z, it is 25Dcur. Session ids are not those of a
    /// source of this process with another `number`, for clients that do not look at sources.
    TuioSink(std::unique_ptr<OscChannel> channel, const std::string& source,
             std::optional<double> unit_height_mm = {}, int number = 0);
    /// Says twice that all touches are over.
    ~TuioSink() override;
    void publish(const TouchReport& report) override;
    void release_all() override;
    void idle() override;

  private:
    void send(const TuioSession::Bundles& bundles);

    std::unique_ptr<OscChannel> channel_;
    std::string source_;
    TuioProfile profile_;
    TuioSession session_;
};

/// touchstone-AREA@ and the host's name, or that of the table with -AREA.
std::string area_source(const std::string& table_source, const std::string& area);

}  // namespace touchstone
