#pragma once

#include <memory>
#include <string>

#include "platform/output/touch_sink.hpp"

namespace touchstone {

/// Passes on the fingers of one named area, with their places in it.
class AreaSink : public TouchSink {
  public:
    AreaSink(std::unique_ptr<TouchSink> sink, std::string area)
        : sink_(std::move(sink)), area_(std::move(area)) {}

    void publish(const TouchReport& report) override;
    void release_all() override { sink_->release_all(); }
    void idle() override { sink_->idle(); }

  private:
    std::unique_ptr<TouchSink> sink_;
    std::string area_;
};

}  // namespace touchstone
