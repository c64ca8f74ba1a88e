#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "platform/output/touch_sink.hpp"

namespace touchstone {

/// One JSON object a processed frame, one a line. Lengths are rounded to 0.01 mm, places in the area to
/// 0.00001.
std::string event_line(const TouchReport& report);

/// `--events`: writes event lines to a file, each handed to the system at once.
class EventLog : public TouchSink {
  public:
    /// Replaces the file; "-" is standard output. Throws Error{io_error} where it cannot be opened.
    explicit EventLog(const std::filesystem::path& path);
    /// Throws Error{io_error} where the line cannot be written.
    void publish(const TouchReport& report) override;

  private:
    struct Closer {
        void operator()(std::FILE* file) const;
    };
    std::string name_;
    std::unique_ptr<std::FILE, Closer> file_;
};

}  // namespace touchstone
