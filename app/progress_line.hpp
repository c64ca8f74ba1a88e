#pragma once

#include <chrono>
#include <ostream>
#include <string_view>

namespace touchstone {

/// One line of a terminal that says how far a long job is, and is gone at its end. Silent where there is no
/// terminal.
class ProgressLine {
  public:
    /// On standard error where that is a terminal.
    ProgressLine();
    /// On `out`, when `shown`, with at least `interval` between two texts.
    ProgressLine(std::ostream& out, bool shown, std::chrono::milliseconds interval)
        : out_(&out), shown_(shown), interval_(interval) {}
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    ~ProgressLine() { clear(); }

    void show(std::string_view text);
    void clear();

  private:
    std::ostream* out_;
    bool shown_;
    std::chrono::milliseconds interval_;
    std::chrono::steady_clock::time_point last_{};
    bool written_ = false;
};

}  // namespace touchstone
